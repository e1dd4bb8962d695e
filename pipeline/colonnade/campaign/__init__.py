"""A campaign: specimens, setups, channels, tests and settings, read from campaign.toml and the test log."""

from colonnade.campaign.campaign import Campaign
from colonnade.campaign.channel import Channel
from colonnade.campaign.loading import FILE_NAME, load
from colonnade.campaign.settings import Processing
from colonnade.campaign.test import Test

__all__ = ["FILE_NAME", "Campaign", "Channel", "Processing", "Test", "load"]
