from planarimpact import bodies as bodies
from planarimpact import collision as collision
from planarimpact import continuum as continuum
from planarimpact import export as export
from planarimpact import fit as fit
from planarimpact import lumped as lumped
from planarimpact import models as models
from planarimpact import noncollinear as noncollinear
from planarimpact import normal_impact as normal_impact
from planarimpact import rigid as rigid
from planarimpact import scene as scene
from planarimpact import spheres as spheres
from planarimpact.collision import Collision as Collision
from planarimpact.collision import Pair as Pair
from planarimpact.collision import collide as collide
from planarimpact.ground.checks import ConvergenceError as ConvergenceError
from planarimpact.ground.checks import InputError as InputError
from planarimpact.ground.results import ContinuumHistory as ContinuumHistory
from planarimpact.ground.results import Event as Event
from planarimpact.ground.results import EventKind as EventKind
from planarimpact.ground.results import History as History
from planarimpact.ground.results import Rebound as Rebound
from planarimpact.ground.results import Regime as Regime

__version__: str
