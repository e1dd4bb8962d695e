"""Study of forecasts whose truth is known: campaigns, their tests, scores and page."""
