"""What the overview shows, a module each part; `report/templates/overview` shows them."""
