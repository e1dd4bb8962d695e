"""How good forecasts of tests were: scores, calibration, references, and what their differences are worth."""
