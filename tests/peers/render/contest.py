"""Engines on the same scene, taking turns, and what comes of it."""

import os
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from statistics import median

import compare
import numpy
from cost import Cost, cost
from peer import Entrant, Peer, Picture, Unavailable

# Blocks must agree before costs mean anything.
MOST_MEDIAN = 0.01


@dataclass(frozen=True)
class Contest:
    """What the first entrant is held against the others for."""

    name: str
    entrants: tuple[Entrant, ...]


def on(scene: str, *engines: str) -> Contest:
    """Gonio against engines on one scene."""
    return Contest(scene, tuple(Entrant(engine, scene) for engine in ("gonio", *engines)))


MITSUBA = ("mitsuba:llvm_ad_rgb", "mitsuba:scalar_rgb")
CONTESTS = [
    on("cornell", "cycles", *MITSUBA),
    on("nine_lights", "cycles"),
    on("glass", "cycles"),
    on("car", "cycles"),
    on("field", "cycles"),
    on("crowd", "cycles"),
    on("street", "cycles"),
    on("diffuse_room", *MITSUBA),
    # 10,000 lights against the ten that matter.
    Contest("hall", (Entrant("gonio", "hall"), Entrant("gonio", "hall.bay"))),
]

# What adaptive sampling and denoising are measured on.
BENCHMARKS = ("cornell", "nine_lights", "glass", "car", "field")


@dataclass(frozen=True)
class Standing:
    """An entrant's figures: one cost a round, the mean of its pictures, how far the first entrant's is from it."""

    entrant: Entrant
    version: str
    preparation: float
    jit: float
    costs: list[Cost]
    image: numpy.ndarray
    noise: float
    difference: compare.Difference

    @property
    def agrees(self) -> bool:
        """Whether the first entrant shows the same."""
        return self.difference.median < MOST_MEDIAN

    def ratio(self, ours: "Standing", of: Callable[[Cost], float]) -> float:
        """The median over rounds of the first entrant's figure over this one's."""
        return median(of(a) / of(b) for a, b in zip(ours.costs, self.costs, strict=True))


@dataclass(frozen=True)
class Result:
    """A contest's standings, the first entrant's first; load is the machine's over the last minute, before and after."""

    name: str
    standings: list[Standing]
    load: tuple[float, float]


def held(contest: Contest, *, seconds: float, rounds: int, scale: float, threads: int, say: Callable[[str], None]) -> Result:
    """Two pictures of each entrant a round, the entrants taking turns; who cannot be had is left out, and said so."""
    before = os.getloadavg()[0]
    with ExitStack() as stack:
        peers = []
        for entrant in contest.entrants:
            try:
                peers.append(stack.enter_context(Peer(entrant, scale=scale, threads=threads)))
            except Unavailable as reason:
                say(f"{entrant.engine} is left out: {reason}")
        for peer in peers:
            peer.calibrate(seconds)
            say(f"{peer.entrant.engine} on {peer.entrant.scene}: {peer.samples} samples, prepared in {peer.preparation:.2f} s")
        pictures: list[list[Picture]] = [[] for _ in peers]
        for seed in range(1, 2 * rounds + 1):
            for peer, made in zip(peers, pictures, strict=True):
                made.append(peer.render(seed))
    return Result(contest.name, standings(peers, pictures), (before, os.getloadavg()[0]))


def standings(peers: list[Peer], pictures: list[list[Picture]]) -> list[Standing]:
    """Figures from all pictures; what is best known of the scene is the mean of all, each engine's by its noise."""
    halves = [[numpy.mean([each.values for each in made[k::2]], axis=0) for k in (0, 1)] for made in pictures]
    measured = [compare.measured(first, second, 0, 0.0) for first, second in halves]
    reference = numpy.average([each.image for each in measured], axis=0, weights=[each.noise**-2 for each in measured])
    found = []
    for peer, made, mean in zip(peers, pictures, measured, strict=True):
        costs = [cost(first, second, reference) for first, second in zip(made[::2], made[1::2], strict=True)]
        difference = compare.difference(measured[0].image, mean.image)
        found.append(Standing(peer.entrant, peer.version, peer.preparation, peer.jit, costs, mean.image, mean.noise, difference))
    return found
