"""Recordings, answers and surveys as xarray's Datasets, and these as files: netCDF-4 (which is HDF5), Zarr, and Parquet by pandas."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from ._containers import beside, chosen, columns_of, layout_from
from ._layout import OF_FRAMES, READINGS, TRACTIONS, Layout
from ._optional import optional
from ._refusal import refused
from ._skin_solution import EARLIER, RESULTANT, SPACE

if TYPE_CHECKING:
    from ._scene import Scene

HDF5, ZARR = (".nc", ".h5", ".hdf5"), (".zarr",)
_SURFACE = ("truth", "tractions", "deviation")
_OTHERS = {
    "wrench": ("of",),
    "wrench_deviation": ("of",),
    "wrench_covariance": ("covariance_row", "covariance_column"),
    "ellipse": ("axis",),
    "ellipse_deviation": ("axis",),
    "space": ("of_space",),
    "space_deviation": ("of_space",),
}
_ORDER = ("t", "row", "column", "channel", "taxel", "reading", "component", "y", "z")


def dataset_of(layout: Layout, scene: Scene) -> Any:
    """A Dataset over t, which counts the frames where their times are not known."""
    xarray = optional("xarray", "tables")
    arrays = layout.arrays
    frame, coordinates = scene._dims
    places, at = scene._surface
    frames = len(arrays["readings"])
    known = "t" in arrays
    t = arrays["t"] if known else np.arange(frames, dtype=float)
    coordinates = {"t": ("t", t, {"units": "s" if known else "frame"})} | coordinates
    components = {name: arrays[name].shape[1] for name in _SURFACE if name in arrays}
    most = max(components.values(), default=0)
    if most > 0:
        coordinates |= {"component": list(scene._components[:most])} | at
    variables: dict[str, Any] = {}
    for name in OF_FRAMES:
        if name not in arrays or name == "t":
            continue
        values = arrays[name]
        if name in _SURFACE:
            more = [(0, 0), (0, most - components[name])] + [(0, 0)] * len(places)
            filling = 0.0 if name == "truth" else np.nan  # no drag pressed, and what was not solved for is not known
            variables[name] = (("t", "component", *places), np.pad(values, more, constant_values=filling))
        elif name == "readings":
            variables[name] = (("t", *frame), values)
        elif name == "touching":
            variables[name] = (("t", *places), values)
        else:
            variables[name] = (("t", *_OTHERS.get(name, ())), values)
    if "wrench" in arrays:
        coordinates |= {"of": list(RESULTANT), "axis": ["radius", "second_radius", "angle"]}
    if "space" in arrays:
        coordinates |= {"of_space": list(SPACE)}
    return xarray.Dataset(variables, coordinates, layout.attributes | {"components": json.dumps(components)})


def layout_in(dataset: Any) -> Layout:
    """The arrays of a Dataset as `dataset_of` makes it, its dimensions in whatever order; of another's what it has by their names."""
    held = dataset.transpose(*_ORDER, ..., missing_dims="ignore").variables
    attributes = {str(key): str(value) for key, value in dataset.attrs.items()}
    arrays = {name: held[name].values for name in (*OF_FRAMES, EARLIER) if name in held}
    if "t" in arrays and held["t"].attrs.get("units") == "frame":
        del arrays["t"]
    for name, count in json.loads(attributes.get("components", "{}")).items():
        arrays[name] = arrays[name][:, :count]
    return Layout(arrays, attributes)


class Exchanged:
    """A result that becomes an xarray.Dataset."""

    def to_xarray(self) -> Any:
        """An xarray.Dataset."""
        raise NotImplementedError

    def save(self, path: str | PathLike[str], *, name: str | None = None, append: bool = False) -> None:
        """Writes `to_xarray()` as netCDF-4 (.nc, .h5) or Zarr (.zarr), which `xarray.open_dataset` reads. The file is
        whole or not there.

        name: of a group in it; None: its root. append: to a file that holds others.
        """
        where = fspath(path)
        suffix = os.path.splitext(where)[1].lower()
        if suffix not in HDF5 + ZARR:
            raise ValueError(f"{where}: this is saved as {', '.join(HDF5 + ZARR)}, not as {suffix or 'a name without'}")
        write(where, self.to_xarray(), name, append)


def write(path: str, dataset: Any, name: str | None, append: bool) -> None:
    """A group of a file of netCDF-4 or of a Zarr, by its suffix; None: its root."""
    from ._files import whole

    if name is not None and not name.isidentifier():
        raise ValueError(f"{path}: name must be letters, digits and _ (got {name!r})")
    suffix = os.path.splitext(path)[1].lower()
    optional("zarr" if suffix in ZARR else "h5netcdf", "zarr" if suffix in ZARR else "hdf5")
    if os.path.isdir(path) and not is_zarr(path):
        raise ValueError(f"{path}: is a folder, and no Zarr")
    if append and os.path.exists(path):
        with _opened(path) as nodes:
            there = [at for at in nodes if _is_array(nodes[at]) and at.rpartition("/")[0] == (name or "")]
        if there:
            raise ValueError(f"{path}: {name or 'its root'} is in the file already: give it another name=")
    with whole(path, append) as to:
        if suffix in ZARR:
            plain = {key: {"_FillValue": None} for key, one in dataset.variables.items() if one.dtype.kind == "f"}
            dataset.to_zarr(to, group=name, mode="a", zarr_format=2, encoding=plain)
            return
        packed = {"zlib": True, "complevel": 1, "shuffle": True, "fletcher32": True}
        encoding = {
            key: (packed if one.size > 0 and one.ndim > 0 else {})
            | ({"_FillValue": None} if one.dtype.kind == "f" else {})
            for key, one in dataset.variables.items()
            if one.dtype.kind in "fiub"
        }
        dataset.to_netcdf(to, group=name, mode="a" if append else "w", engine="h5netcdf", encoding=encoding)


def is_zarr(path: str) -> bool:
    return any(os.path.exists(os.path.join(path, one)) for one in (".zgroup", ".zattrs", "zarr.json"))


@contextmanager
def _opened(path: str) -> Iterator[dict[str, Any]]:
    """Its groups and arrays by their paths, the root by an empty one: of h5py or zarr, which are alike."""
    optional("xarray", "hdf5")
    try:
        if os.path.isdir(path):
            root = optional("zarr", "zarr").open_group(path, mode="r")
            yield {"": root} | dict(sorted(root.members(max_depth=None)))
            return
        optional("h5netcdf", "hdf5")
        nodes: dict[str, Any] = {}
        with optional("h5py", "hdf5").File(path, "r") as file:
            file.visititems(lambda at, node: nodes.update({at: node}))  # which returns None: else it would end
            yield {"": file} | nodes
    except (OSError, EOFError) as error:
        kind = "Zarr" if os.path.isdir(path) else "HDF5 file"
        raise refused(path, f"is not a whole {kind}: {error}", "was it closed, and copied as a whole?") from None


def _is_array(node: Any) -> bool:
    return hasattr(node, "dtype") and hasattr(node, "ndim")


def read(path: str, name: str | None) -> Layout:
    """One of the groups of a file of netCDF-4 or any HDF5, or of a Zarr; or a stranger's dataset in it."""
    with _opened(path) as nodes:
        own = [
            at
            for at, node in nodes.items()
            if not _is_array(node)
            and str(node.attrs.get("format")) in (READINGS, TRACTIONS)
            and name in (None, at, at.rpartition("/")[2])
        ]
        if len(own) > 1:
            names = ", ".join(at.rpartition("/")[2] or "one in its root" for at in own)
            raise refused(path, f"holds {names}", "name= one of them")
        if not own:
            return _strangers(path, {at: node for at, node in nodes.items() if _is_array(node)}, name)
    xarray = optional("xarray", "hdf5")
    how = (
        {"engine": "zarr", "consolidated": False}
        if os.path.isdir(path)
        else {"engine": "h5netcdf", "phony_dims": "sort"}
    )
    raw = {"mask_and_scale": False, "decode_times": False, "decode_coords": False}
    with xarray.open_dataset(path, group=own[0] or None, **raw, **how) as dataset:
        return layout_in(dataset.load())


def _strangers(path: str, arrays: dict[str, Any], name: str | None) -> Layout:
    numeric = {at: array for at, array in arrays.items() if array.dtype.kind in "fiu" and array.ndim > 0}
    key = chosen(path, numeric, name, "dataset")
    at = beside(numeric, key)
    units = numeric[key].attrs.get("units")
    held = {"readings": numeric[key][...]} | ({} if at is None else {"t": numeric[at][...]})
    return Layout(held, units=None if units is None else units.decode() if isinstance(units, bytes) else str(units))


# Parquet: a frame a row, a reading a column, as a CSV has them; attributes are those of the DataFrame.


def write_parquet(path: str, layout: Layout, scene: Scene) -> None:
    pandas = optional("pandas", "tables")
    optional("pyarrow", "tables")
    frame = pandas.DataFrame(dict(columns_of(layout, scene)))
    frame.attrs = layout.attributes
    frame.to_parquet(path, index=False, compression="zstd")


def read_parquet(path: str, name: str | None) -> Layout:
    pandas = optional("pandas", "tables")
    arrow = optional("pyarrow", "tables")
    try:
        schema = optional("pyarrow.parquet", "tables").read_schema(path)
        frame = pandas.read_parquet(path)
    except (arrow.ArrowException, OSError, ValueError) as error:
        first = str(error).partition("\n")[0]
        raise refused(
            path,
            f"is not a whole Parquet file: {first}",
            "its table stands at its end, so that nothing of a part can be read",
        ) from None
    if frame.attrs.get("format") == READINGS:
        return layout_from(list(frame.columns), frame.to_numpy(dtype=np.float64), dict(frame.attrs), [])
    return _foreign(path, frame.reset_index() if frame.index.name else frame, schema, name)


def _foreign(path: str, frame: Any, schema: Any, name: str | None) -> Layout:
    """A list a row under one name, or a number a column under names that end in numbers: as one writes a DataFrame."""
    named: dict[str, Any] = {}
    for key in frame.columns:
        values = frame[key].to_numpy()
        if values.dtype.kind == "O" and len(values) > 0 and isinstance(values[0], np.ndarray):
            if len({np.shape(one) for one in values}) > 1:
                raise refused(
                    path, f"has lists of different lengths in {key!r}", "a frame has as many readings in each row"
                )
            values = np.stack(values)
        if values.dtype.kind in "fiuM":
            named[str(key)] = values
    columns = None
    wide = {key: values for key, values in named.items() if key[-1:].isdecimal() and values.ndim == 1}
    if name is None and wide and not any(values.ndim == 2 for values in named.values()):
        columns = list(wide)
        named = {key: values for key, values in named.items() if key not in wide}
        named["readings"] = np.stack(list(wide.values()), axis=1)
    key = chosen(path, named, name, "column")
    at = beside(named, key)
    unit = (schema.field(key).metadata or {}).get(b"units") if key in schema.names else None
    held = {"readings": named[key]} | ({} if at is None else {"t": named[at]})
    return Layout(held, units=None if unit is None else unit.decode(), columns=columns)
