"""The block as a solid body on a table that it touches at the nodes of its base: contact, friction, elasticity."""
