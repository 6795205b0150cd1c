"""``python -m verification model``: what load sharing leaves out, measured against one gap with one pressure.

The same surfaces, loads and fluids are solved by Eq. (8) over the Hertz strip and over the box, by two deflections of
the film, and by ``numerics.model = "deterministic"``, which is the reference. The exit code is 1 when a point of the
reference failed, or when the error of the model is larger than the results state.
"""

from argparse import ArgumentParser, Namespace

from .. import frame

PARTS: tuple[tuple[str, str, str, dict], ...] = (
    ("model-error", "model.error:model_error", "Load sharing beside one gap, one pressure", {}),
    ("held-out", "model.error:held_out", "The stated error of the model on other surfaces", {}),
    ("boundary-film", "model.boundary_film:boundary_film", "How thick the boundary film should be", {}),
    ("grids", "model.film:grids", "One gap, one pressure on ever smaller cells", {}),
)


def main(argv: list[str]) -> int:
    """The command."""
    return frame.main(frame.campaign("model", __doc__, PARTS, add_options=_options, own=_own), argv)


def _options(parser: ArgumentParser) -> None:
    words = "every model on the measured map of this scene, in place of the generated surfaces of model-error"
    parser.add_argument("--map", metavar="SCENE", help=words)


def _own(part: str, options: Namespace) -> dict:
    return {"scene": options.map} if part == "model-error" and options.map else {}
