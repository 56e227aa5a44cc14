"""Sweeps: operations with all combinations of their parameters, each settled and measured."""

from __future__ import annotations

import dataclasses
import itertools
import warnings
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor, Future
from typing import Any, Optional, Union

import numpy as np

from . import ops as operations
from ._core import Simulator, Snapshot
from .arrays import Valve
from .errors import ArgumentError, Error, ValveWarning
from .kinds import SYSTOLE_PA
from .ops import FieldType, Operation
from .tables import Row, Table
from .values import Cost, Load, Measures, unit_of
from .words import shown

Step = Union[Operation, tuple[str, Mapping[str, Any]]]
"""An operation, or its name with its fields, where a field may hold a list of values."""

_PLAIN = (FieldType.NUMBER, FieldType.COUNT)
_WARNING = 2  # MVS_LOG_WARNING


@dataclasses.dataclass(frozen=True)
class _Task:
    """One combination: everything that a worker needs."""

    start: Snapshot
    operations: tuple[Operation, ...]
    load: Load
    settle: Mapping[str, Any]
    cost: Optional[Mapping[str, Any]]


def sweep(
    valve: Union[Valve, Snapshot],
    ops: Iterable[Step],
    executor: Optional[Executor] = None,
    *,
    pressure_pa: Optional[float] = None,
    settle: Optional[Mapping[str, Any]] = None,
    cost: Optional[Mapping[str, Any]] = None,
) -> Table:
    """Applies operations with all combinations of their parameters: a mvs.Table, a row for each.

        mvs.sweep(valve, [("ring", {"size": [28e-3, 30e-3, 32e-3]}),
                          ("chord_length", {"chord": "A2/7", "factor": [0.7, 0.8, 0.9]})],
                  ProcessPoolExecutor())

    Each combination starts from the same valve or snapshot, is settled under the pressure and
    measured. `mvs sweep` closes the valve before it operates, and this function operates on the valve
    as given: give it a closed snapshot for the same figures. Arguments that fit no valve, as a factor of 0 or a
    pressure of NaN, raise before any work. Columns: the parameters with several values ("ring.size"),
    "converged", the fields of mvs.Measures in SI units, and "error", the sentence of an impossible
    combination, whose measures are NaN. The rows are in the order of the combinations, the last parameter fastest, and do not
    depend on the executor. Warnings of the library (mvs.ValveWarning) come once for all rows.

    ops: pairs of a name and its fields, or mvs.Operation. A list holds the values of a parameter;
        numbers may also be a range or an array. Points of a curve are an array, a site a tuple
    executor: any of concurrent.futures; None: one after another in this thread. An exception, as of Ctrl-C,
        cancels the rows that have not begun
    pressure_pa: Pa, with the annulus and the heads where they are under load; None: the load of the
        snapshot, pressure and boundary fraction, else 120 mmHg
    settle: arguments of Simulator.settle
    cost: arguments of Snapshot.cost, {} for its defaults; adds columns "cost.open_area", ... with
        the fields of mvs.Cost. None: costs are not measured
    """
    _check_executor(executor)
    start = valve if isinstance(valve, Snapshot) else _snapshot_of(valve)
    load = Load(SYSTOLE_PA if pressure_pa is None else pressure_pa, 1.0)
    if pressure_pa is None and start.load_case.pressure:
        load = start.load_case
    choices = _all_choices(ops)
    varied = [c.label for c in choices if c.field and len(c.values) > 1]
    tasks, parameters = [], []
    for values in itertools.product(*(c.values for c in choices)):
        parameters.append({c.label: v for c, v in zip(choices, values) if c.label in varied})
        tasks.append(_Task(start, _operations(choices, values), load, dict(settle or {}), cost))
    _check_common(start, load, dict(settle or {}), cost)
    results = list(map(_run, tasks)) if executor is None else _run_in(executor, tasks)
    _warn_once(sentence for each in results for sentence in each.warnings)
    units = _units(choices, varied, cost is not None)
    return Table(({**p, **each.row} for p, each in zip(parameters, results)), units)


def _check_executor(executor: Any) -> None:
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise ArgumentError(
            f"executor: an executor of concurrent.futures or None is needed, not {shown(executor)}", "executor"
        )


def _check_common(
    start: Snapshot, load: Load, settle: dict[str, Any], cost: Optional[Mapping[str, Any]]
) -> None:
    """Raises for a load and options that no row can have, without closing or opening the valve.

    Errors of other kinds are of the start, which the operations may change: they are left to the rows.
    """
    settle.pop("progress", None)  # begin_settle has none
    try:
        with Simulator(log=lambda level, text: None) as sim:
            sim.restore(start)
            sim.set_load(load.pressure, load.boundary_fraction)
            sim.begin_settle(**settle)
        if cost is not None:
            start.cost(**{**cost, "progress": lambda share, residual: True})
    except (ArgumentError, TypeError):
        raise
    except Error:
        pass


def _run_in(executor: Executor, tasks: Sequence[_Task]) -> list[_Done]:
    """The rows in order. Rows that wait in the executor are cancelled if one raises or Ctrl-C comes."""
    futures: list[Future[_Done]] = []
    try:
        for task in tasks:
            futures.append(executor.submit(_run, task))
        return [future.result() for future in futures]
    except BaseException:
        for future in futures:
            future.cancel()
        raise


@dataclasses.dataclass(frozen=True)
class _Done:
    """A row, and the warnings of the library about its operations and load."""

    row: Row
    warnings: tuple[str, ...]


def _warn_once(sentences: Iterable[str]) -> None:
    """Every sentence once, at the line that called sweep()."""
    for sentence in dict.fromkeys(sentences):
        warnings.warn(sentence, ValveWarning, stacklevel=3)


@dataclasses.dataclass(frozen=True)
class _Choice:
    """The values of one field; without a field the operation itself, which then has none."""

    number: int
    kind: str
    field: str
    values: Sequence[Any]
    label: str = ""


def _all_choices(ops: Iterable[Step]) -> list[_Choice]:
    choices: list[_Choice] = []
    for number, step in enumerate(ops):
        for each in _choices(number, step):
            # a second operation of a kind has its number in the names of its columns
            again = any(c.kind == each.kind and c.number != number for c in choices)
            label = f"{each.kind}{f' {number + 1}' if again else ''}.{each.field}"
            choices.append(dataclasses.replace(each, label=label))
    return choices


def _choices(number: int, step: Step) -> list[_Choice]:
    if isinstance(step, Operation):
        return [_Choice(number, step.kind.name, "", [step])]
    try:
        name, fields = step
        given = dict(fields)
    except (TypeError, ValueError):
        raise ArgumentError(
            f"ops: a mvs.Operation or a pair (name, fields) is needed, not {shown(step)}", "ops"
        ) from None
    if name not in operations.KINDS:
        Operation(name)
    kind = operations.KINDS[name]
    return [_Choice(number, name, "", [None])] + [
        _Choice(number, name, key, _values(kind.field(key), value)) for key, value in given.items()
    ]


def _values(field: operations.OpField, given: Any) -> Sequence[Any]:
    if isinstance(given, list):
        values = given
    elif field.type in _PLAIN and isinstance(given, (tuple, range, np.ndarray)):
        values = [each.item() if hasattr(each, "item") else each for each in given]
    else:
        values = [given]
    if not values:
        raise ArgumentError(f"ops: {field.kind}.{field.name} has no values", "ops")
    return values


def _operations(choices: Sequence[_Choice], values: Sequence[Any]) -> tuple[Operation, ...]:
    made = []
    for _, group in itertools.groupby(zip(choices, values), key=lambda pair: pair[0].number):
        (first, given), *fields = group
        made.append(given or Operation(first.kind, **{c.field: v for c, v in fields}))
    return tuple(made)


def _units(choices: Sequence[_Choice], varied: Sequence[str], cost: bool) -> dict[str, str]:
    units = {
        c.label: operations.KINDS[c.kind].field(c.field).unit for c in choices if c.label in varied
    }
    units["converged"] = ""
    for field in dataclasses.fields(Measures):
        unit = unit_of(Measures, field.name)
        units[field.name] = "" if unit == "1" else unit
    for name in _cost_names() if cost else ():
        unit = unit_of(Cost, name)
        units[f"cost.{name}"] = "" if unit == "1" else unit
    units["error"] = ""
    return units


def _cost_names() -> list[str]:
    """Those that the measures do not have, without the open valve."""
    measures = {field.name for field in dataclasses.fields(Measures)}
    names = [field.name for field in dataclasses.fields(Cost)]
    return [name for name in names if name not in measures and name != "open_valve"]


def _snapshot_of(valve: Any) -> Snapshot:
    if not isinstance(valve, Valve):
        raise ArgumentError(f"valve: a mvs.Valve or mvs.Snapshot is needed, not {shown(valve)}", "valve")
    with Simulator() as sim:
        sim.set_valve(valve)
        return sim.snapshot()


def _run(task: _Task) -> _Done:
    """One row; an impossible combination is a row with its sentence. Runs in a worker."""
    said: list[str] = []
    row = _row(task, said)
    return _Done(row, tuple(said))


def _row(task: _Task, said: list[str]) -> Row:
    def log(level: int, text: str) -> None:
        # "converged" says how a settle ended
        if level <= _WARNING and not settling:
            said.append(text)

    settling = False
    names = [field.name for field in dataclasses.fields(Measures)]
    costs = _cost_names() if task.cost is not None else []
    row: dict[str, Any] = dict.fromkeys([*names, *(f"cost.{name}" for name in costs)], float("nan"))
    try:
        with Simulator(log=log) as sim:
            sim.restore(task.start)
            for operation in task.operations:
                sim.apply(operation)
            sim.set_load(task.load.pressure, task.load.boundary_fraction)
            settling = True
            converged = sim.settle(**task.settle).converged
            closed = sim.snapshot()
        row.update({name: getattr(closed.measures, name) for name in names})
        if task.cost is not None:
            cost = closed.cost(**task.cost)
            row.update({f"cost.{name}": getattr(cost, name) for name in costs})
    except Error as error:
        return {"converged": False, **dict.fromkeys(row, float("nan")), "error": str(error)}
    return {"converged": converged, **row, "error": ""}
