"""A sequence of named stages whose results are kept, so that each can be looked at or replaced.

    pipeline = mvs.imaging.microct.PIPELINE.replaced("tissue", my_threshold)
    run = pipeline.run({"image": image})
    run["muscles"], run.seconds["muscles"]
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Mapping
from typing import Any, Optional

from mvs import ArgumentError

Stage = Callable[[Mapping[str, Any]], Any]


@dataclasses.dataclass(frozen=True)
class Pipeline:
    """Stages in order: each is a function of the results of those before it, by name."""

    stages: tuple[tuple[str, Stage], ...]

    def replaced(self, name: str, stage: Stage) -> "Pipeline":
        """The same pipeline with another function for one stage."""
        names = [known for known, _ in self.stages]
        if name not in names:
            raise ArgumentError(f'there is no stage "{name}"; the stages are {", ".join(names)}', name)
        return Pipeline(tuple((known, stage if known == name else old) for known, old in self.stages))

    def run(self, given: Mapping[str, Any], until: Optional[str] = None,
            progress: Optional[Callable[[str], object]] = None) -> "Run":
        """Runs the stages, up to and including `until`. A result that is given is not computed."""
        run = Run(dict(given), {})
        for name, stage in self.stages:
            if name not in run.results:
                if progress:
                    progress(name)
                start = time.process_time()
                run.results[name] = stage(run.results)
                run.seconds[name] = time.process_time() - start
            if name == until:
                break
        return run


@dataclasses.dataclass(frozen=True)
class Run:
    """Results of the stages by name, and the CPU seconds of each."""

    results: dict[str, Any]
    seconds: dict[str, float]

    def __getitem__(self, name: str) -> Any:
        return self.results[name]

    def table(self) -> tuple[tuple[str, float, str], ...]:
        """Name, CPU seconds and result in words of each stage that ran."""
        return tuple((name, seconds, str(self.results[name])) for name, seconds in self.seconds.items())
