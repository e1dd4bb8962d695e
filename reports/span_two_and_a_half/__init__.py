"""Why the computed response could grow at Span 2.5 when the measured one had died down."""
