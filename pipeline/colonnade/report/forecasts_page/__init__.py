"""The page of forecasts: what was foreseen, what happened, and what the forecasts are worth."""
