"""When the tests of a plan were run, and whose folder it may write to."""

import numpy as np
import pytest

from colonnade.campaign import FILE_NAME
from colonnade.errors import CampaignError
from colonnade.laboratory.plan import MARK, TESTS_A_DAY, Plan, begun, claim


@pytest.mark.parametrize("content", ["schema = 1\n", ""], ids=["of a laboratory", "empty"])
def test_a_campaign_file_of_another_hand_is_not_replaced(tmp_path, content):
    claim(tmp_path)
    path = tmp_path / FILE_NAME
    path.write_text(content, encoding="utf-8")
    with pytest.raises(CampaignError, match="was not written by the virtual laboratory and was not changed"):
        claim(tmp_path)
    text = Plan("schema = 1", {}, {}, ()).campaign_text()
    assert text.startswith(MARK)
    path.write_text(text, encoding="utf-8")
    claim(tmp_path)


def test_tests_follow_each_other_on_working_days_between_nine_and_four():
    moments = [begun(position) for position in range(10 * TESTS_A_DAY)]
    assert moments == sorted(set(moments))
    assert len({moment.date() for moment in moments}) == 10
    assert np.is_busday([moment.date() for moment in moments]).all()
    assert {moment.hour for moment in moments} == set(range(9, 16))
