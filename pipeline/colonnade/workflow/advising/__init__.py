"""Which test tells most: what is known of a campaign, put to the advice on sine tests, free vibrations and Spans."""
