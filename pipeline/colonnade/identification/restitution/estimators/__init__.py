"""The estimators of the coefficient of restitution, one module each."""
