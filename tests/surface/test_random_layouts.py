"""Maps and curves in random layouts, from the generator of ``python -m verification stability --only bad-inputs``."""

import numpy as np
import pytest

from verification.campaigns.hostile.case import GOOD, judge
from verification.campaigns.hostile.layouts import KINDS, cases


@pytest.mark.parametrize("seed", range(3))
def test_a_layout_is_read_as_what_it_is_or_refused(tmp_path, seed):
    ended = []
    for number, case in enumerate(cases(np.random.default_rng([7, seed]), 9 * len(KINDS))):
        folder = tmp_path / str(number)
        folder.mkdir()
        verdict, words = judge(case, folder)
        if verdict not in GOOD:
            ended.append(words)
    assert ended == []
