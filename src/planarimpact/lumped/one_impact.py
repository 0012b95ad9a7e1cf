"""Stub."""

from planarimpact.common.losses import Loss


def rebound(loss: Loss, x: float, beta: float, zeta2: float, e: float):
    return None
