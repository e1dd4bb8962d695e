"""One registry of the models of rocking; one module a model says what it needs, gives, costs and looks like."""
