"""What every store does (`lubfric.studies.store_contract.RecordStore`): that of files, and one in memory."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import pytest
from small_study import SCENE

import lubfric
from lubfric.studies import Store, digest, fits
from lubfric.studies.store import OUTCOME
from lubfric.studies.store_contract import RecordStore


class InMemory(RecordStore):
    """A store in this process, whose records are pickled so that nobody changes them."""

    def __init__(self, _):
        self.records = {}

    def add(self, key, outcome, *, sync=False):
        self.records[key] = pickle.dumps(outcome)

    def get(self, key, kind=object):
        record = pickle.loads(self.records[key]) if key in self.records else None
        good = isinstance(record, lubfric.LubfricError) or kind is object or fits(record, kind)
        return record if good else None

    def has(self, key):
        return key in self.records


@pytest.fixture(params=[Store, InMemory])
def store(request, tmp_path):
    return request.param(tmp_path)


def test_what_was_added_comes_back_and_nothing_else(store):
    point = lubfric.friction(SCENE, 0.3).without_fields()
    assert store.get("a" * 64) is None and not store.has("a" * 64)
    store.add("a" * 64, point, sync=True)
    store.add("b" * 64, ((0.1, 0.2), True))
    store.add("c" * 64, lubfric.InputError("no such load"))
    assert digest(store.get("a" * 64, OUTCOME)) == digest(point) and store.has("a" * 64)
    assert store.get("b" * 64, tuple[tuple[float, ...], bool]) == ((0.1, 0.2), True)
    assert isinstance(store.get("c" * 64), lubfric.InputError) and "no such load" in str(store.get("c" * 64))
    assert store.get("d" * 64) is None


@pytest.mark.filterwarnings("ignore:.*another version")
def test_a_record_of_another_type_counts_as_absent(store):
    store.add("a" * 64, (1, 2))
    assert store.get("a" * 64, OUTCOME) is None and store.has("a" * 64)


def test_records_that_several_add_at_once_are_whole(store):
    with ThreadPoolExecutor(8) as executor:
        list(executor.map(lambda i: store.add(digest(i % 10), (i % 10, 0.5)), range(200)))
    assert [store.get(digest(i)) for i in range(10)] == [(i, 0.5) for i in range(10)]
