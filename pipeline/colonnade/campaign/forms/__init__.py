"""What is written as JSON: the models of the summary and of forecasts, and the schemas made from them."""
