"""HDF5: a group for each sensor, observations/tactile/NAME, as episodes of robot learning have them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._containers import beside, chosen
from ._layout import READINGS, TRACTIONS, Layout
from ._optional import optional
from ._refusal import refused

GROUP = "observations/tactile"
_PACKED = {"compression": "gzip", "compression_opts": 1, "shuffle": True, "fletcher32": True}


def write(path: str, layout: Layout, name: str) -> None:
    """Adds the group to what the file holds. Raises ValueError where it holds one of that name."""
    h5py = optional("h5py", "hdf5")
    with h5py.File(path, "a", libver=("v108", "latest")) as file:  # older forms hold no long attribute
        if f"{GROUP}/{name}" in file:
            raise ValueError(f"{GROUP}/{name} is in the file already: give it another name=")
        group = file.create_group(f"{GROUP}/{name}")
        for key, values in layout.arrays.items():
            if values.dtype.kind == "U":
                group.create_dataset(key, data=values.astype(object), dtype=h5py.string_dtype())
            else:
                group.create_dataset(key, data=values, **(_PACKED if values.size > 0 else {}))
        group.attrs.update(layout.attributes)


def read(path: str, name: str | None) -> Layout:
    h5py = optional("h5py", "hdf5")
    try:
        with h5py.File(path, "r") as file:
            return _read(h5py, path, file, name)
    except OSError as error:
        raise refused(path, f"is not a whole HDF5 file: {error}", "was it closed, and copied as a whole?") from None


def _read(h5py: Any, path: str, file: Any, name: str | None) -> Layout:
    groups: dict[str, Any] = {}
    datasets: dict[str, Any] = {}

    def visit(at: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset):
            datasets[at] = node
        elif node.attrs.get("format") in (READINGS, TRACTIONS):
            groups[at] = node

    file.visititems(visit)
    own = {at: node for at, node in groups.items() if name in (None, at, at.removeprefix(f"{GROUP}/"))}
    if len(own) > 1:
        raise refused(path, f"holds {', '.join(at.removeprefix(f'{GROUP}/') for at in own)}", "name= one of them")
    for node in own.values():
        arrays = {key: _array(h5py, one) for key, one in node.items()}
        return Layout(arrays, {key: str(value) for key, value in node.attrs.items()})
    numeric = {at: node for at, node in datasets.items() if node.dtype.kind in "fiu" and node.ndim > 0}
    key = chosen(path, numeric, name, "dataset")
    at = beside(numeric, key)
    units = numeric[key].attrs.get("units")
    held = {"readings": numeric[key][()]} | ({} if at is None else {"t": numeric[at][()]})
    return Layout(held, units=None if units is None else _text(units))


def _array(h5py: Any, dataset: Any) -> Any:
    text = h5py.check_string_dtype(dataset.dtype) is not None
    return np.array(dataset.asstr()[()], dtype=np.str_) if text else dataset[()]


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)
