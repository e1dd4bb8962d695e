"""A draft of campaign.toml from the raw files: what is known, what is guessed and why, and what is asked."""

from colonnade.campaign.draft.write import CampaignDraft, Question, draft

__all__ = ["CampaignDraft", "Question", "draft"]
