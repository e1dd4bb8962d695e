"""The sections of a test's page, a module each: its facts and its pictures. `templates/test.html.jinja` shows them."""
