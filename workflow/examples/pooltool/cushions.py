"""Cushions of pooltool that bounce as `planarimpact.collide` says."""

from functools import cache

import attrs
import numpy as np
import pooltool as pt
from pooltool.constants import sliding
from pooltool.objects import Ball
from pooltool.objects.ball.datatypes import BallState
from pooltool.physics.resolve.ball_cushion.core import (
    CoreBallCCushionCollision,
    CoreBallLCushionCollision,
)

from planarimpact import Pair, bodies, collide

STIFFNESS_RATIO = 1.409  # zeta^2, as of collision.presets()["billiard_ball_on_cushion"]


@cache
def pair_and_body(friction: float, restitution: float, radius: float, mass: float):
    """Made once for each kind of ball, as this takes longer than an impact."""
    pair = Pair(
        friction=friction,
        stiffness_ratio=STIFFNESS_RATIO,
        restitution=restitution,
        loss="viscous",
    )
    return pair, bodies.solid_sphere(radius, mass=mass)


class Bounce:
    """The step that all cushions share: velocity and spin of the ball after the impact."""

    def solve(self, ball: Ball, cushion):
        given = ball.params
        pair, body = pair_and_body(given.f_c, given.e_c, given.R, given.m)
        place, velocity, spin = ball.state.rvw
        normal = cushion.get_normal_3d(place)  # from the cushion to the ball
        after = collide(pair, normal, body, velocity, spin)
        ball.state = BallState(np.array([place, after.velocity, after.spin]), sliding)
        ball.state.rvw[1, 2] = 0.0  # as in pooltool's own models, balls do not jump
        return ball, cushion


@attrs.define
class Linear(Bounce, CoreBallLCushionCollision):
    """Straight cushions."""


@attrs.define
class Circular(Bounce, CoreBallCCushionCollision):
    """Round ends of cushions, at pockets."""


def engine() -> pt.physics.PhysicsEngine:
    """pooltool's usual physics with these cushions: `pt.simulate(shot, engine=engine())`."""
    usual = pt.physics.PhysicsEngine()
    usual.resolver = attrs.evolve(
        usual.resolver, ball_linear_cushion=Linear(), ball_circular_cushion=Circular()
    )
    return usual


if __name__ == "__main__":
    table = pt.Table.default()
    balls = {"cue": pt.Ball.create("cue", xy=(0.5, 0.3))}
    shot = pt.System(cue=pt.Cue(cue_ball_id="cue"), table=table, balls=balls)
    shot.cue.set_state(V0=2.0, phi=35.0, b=0.3)
    pt.simulate(shot, engine=engine(), inplace=True)
    for event in shot.events:
        if "cushion" in event.event_type:
            _, velocity, spin = event.agents[0].final.state.rvw
            print(
                f"{event.time:.3f} s: velocity {velocity.round(3)} m/s, spin {spin.round(1)} rad/s"
            )
