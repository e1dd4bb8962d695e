"""A test of a campaign through the stages one by one, each with the inputs that the campaign gives it."""

from colonnade.campaign import load
from colonnade.campaign.channel import RecordedAs
from colonnade.stages.compare import CompareInputs, compare
from colonnade.stages.condition import ConditionInputs, condition
from colonnade.stages.ingest import IngestInputs, ingest
from colonnade.stages.predict import PredictInputs, predict
from colonnade.stages.restitution import RestitutionInputs, restitution
from colonnade.stages.rocking import RockingInputs, rocking
from colonnade.stages.specimen import SpecimenInputs, specimen


def _of(campaign, test):
    return campaign.tests[test] if isinstance(test, str) else test


def changed(campaign, *changes):
    """The campaign after changes of its file, each of its first place only."""
    text = campaign.path.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    campaign.path.write_text(text, encoding="utf-8")
    return load(campaign.path)


def plain_channel(quantity, **changes):
    """A channel of the main recorder on the specimen, along x, without unit, gain and range if none are given."""
    return RecordedAs.model_construct(**{"column": "a", "quantity": quantity, "on": "specimen"} | changes)


def ingested(campaign, test, recordings, **changes):
    """Each of these takes changes of the last stage's inputs."""
    return ingest(recordings, IngestInputs.of(campaign, _of(campaign, test)).model_copy(update=changes))


def conditioned(campaign, test, recordings, **changes):
    read = ConditionInputs.of(campaign, _of(campaign, test)).model_copy(update=changes)
    return condition(ingested(campaign, test, recordings), read)


def measured(campaign, test, recordings):
    """The channels on one clock, and the rocking angle from them."""
    ready = conditioned(campaign, test, recordings)
    return ready, rocking(ready, RockingInputs.of(campaign, _of(campaign, test)))


def identified(campaign, angle, test="free-01", **changes):
    return restitution(angle, RestitutionInputs.of(campaign, campaign.tests[test]).model_copy(update=changes))


def pooled(campaign, found, **changes):
    return specimen(found, SpecimenInputs.of(campaign, "prism").model_copy(update=changes))


def predicted(campaign, test, angle, of_specimen, model="linear", free=None, **changes):
    """`free` is the e that was identified from the same test, if it is a free vibration."""
    read = PredictInputs.of(campaign, _of(campaign, test), model).model_copy(update=changes)
    return predict(angle, of_specimen, read, None, free)


def compared(campaign, test, angle, predictions, ensembles=None, **changes):
    read = CompareInputs.of(campaign, _of(campaign, test)).model_copy(update=changes)
    return compare(angle, predictions, read, ensembles or {})
