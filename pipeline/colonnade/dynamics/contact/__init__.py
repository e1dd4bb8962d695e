"""The contact model: a solid body that touches the table at the nodes of its base, with friction and elasticity."""
