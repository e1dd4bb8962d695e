"""A campaign file to start from, guessed from the raw files: what is known, what is guessed and why, what is asked."""

from colonnade.campaign.draft.drafting import CampaignDraft, Question, draft

__all__ = ["CampaignDraft", "Question", "draft"]
