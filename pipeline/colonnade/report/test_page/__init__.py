"""The sections of a test's page, a module each: its facts and its pictures. `report/templates/sections` shows them."""
