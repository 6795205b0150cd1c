"""From a prepared scene and a speed to a `lubfric.FrictionResult`, in one of three ways that are independent of each
other.

- `load_sharing`: film and contact share the load, on a long line or a patch.
- `deterministic`: one gap and one pressure.
- `one_way`: a film in the contact's own gap.

`resolved` has what the last two have in common. `methods` names the methods behind a result.
"""
