"""The two models of a mixed-lubricated contact, under one contract: load sharing after the paper, and deterministic."""

from .contract import ContactFields, Model, ModelAnswer, SampleSolution
from .deterministic import DeterministicModel
from .load_sharing import PaperModel
