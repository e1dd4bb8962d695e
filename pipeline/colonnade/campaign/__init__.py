"""What a campaign is: specimens, setups, channels, tests and settings, read from campaign.toml and the test log."""

from colonnade.campaign.campaign import Campaign
from colonnade.campaign.channel import MAIN, Channel
from colonnade.campaign.loading import FILE_NAME, load
from colonnade.campaign.settings import PredictSettings, Processing, RestitutionSettings, Setting, settings
from colonnade.campaign.setup import Align, FileOptions, Recorder, Setup
from colonnade.campaign.specimen import Specimen
from colonnade.campaign.test import Test

__all__ = [
    "FILE_NAME",
    "MAIN",
    "Align",
    "Campaign",
    "Channel",
    "FileOptions",
    "PredictSettings",
    "Processing",
    "Recorder",
    "RestitutionSettings",
    "Setting",
    "Setup",
    "Specimen",
    "Test",
    "load",
    "settings",
]
