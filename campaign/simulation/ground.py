"""The ground that all realizations of a scene share, and the door to each of them."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from campaign.errors import RefusalError
from campaign.fields.properties import BY_NAME, PROPERTIES, SoilProperty, marginals, raised_to_floor
from campaign.fields.strengths import Strengths, StrengthSampler
from campaign.record import Quantity, Record, with_dims
from campaign.scene.ground_surface import surface_of
from campaign.scene.layers import layer_names, layer_scenes, random_properties
from campaign.scene.scene import Scene
from campaign.seeds import BASELINE
from campaign.simulation.contract import TEXT, sizes
from campaign.simulation.field_summary import BoxMap, box_map
from campaign.simulation.kept_in_situ import kept_in_situ_state
from campaign.simulation.quantities import QUANTITIES
from campaign.simulation.realization import never, nothing, simulate
from campaign.simulation.scene_sampler import strength_sampler
from campaign.simulation.solver_model import Array, column_edges, model_of, output_times
from campaign.terminal import say
from solver.compile_cache import telling_of_compilation
from solver.in_situ import NotSettledError
from solver.march import March
from solver.model import Model
from solver.observables import deposit_surface
from solver.particles import Particles, copy_particles
from solver.pore_pressure import wet_ground_of
from solver.surface import Surface

if TYPE_CHECKING:
    import xarray as xr


COMPILING = "Compiling the solver for this kind of scene, once; it takes about half a minute."


@dataclass(frozen=True)
class Ground:
    """What all realizations of a scene share.

    Parameters
    ----------
    scene : Scene
    model : solver.model.Model
        The scene as the solver sees it.
    lattice : Particles
        The particles on their lattice, where they read the random field.
    in_situ : Particles
        The same particles when strength is released: at rest under gravity, or unloaded for a gravity ramp.
    settled : Particles
        The same particles at rest under gravity, from whose places displacement counts.
    sampler : StrengthSampler
        Draws the strengths of a realization.
    """

    scene: Scene
    model: Model
    lattice: Particles
    in_situ: Particles
    settled: Particles
    sampler: StrengthSampler

    @cached_property
    def coordinates(self) -> dict[str, NDArray[Any]]:
        """Arrays by the names of `contract.COORDINATES` and `SHARED`; "x" is the middle of the deposit's columns."""
        edges, numerics = column_edges(self.model), self.scene.numerics
        places = {
            "time": output_times(numerics.end_time, numerics.output_interval),
            "x": 0.5 * (edges[1:] + edges[:-1]),
            "particle_x": self.lattice.x,
            "particle_y": self.lattice.y,
            "initial_surface": deposit_surface(self.settled, 0.5 * self.model.particle_spacing, edges),
        }
        if self.random_properties:
            places |= {
                "property": np.array([row.name for row in self.random_properties], dtype=TEXT),
                "box_x": self.boxes.x,
                "box_y": self.boxes.y,
            }
        if self.scene.layer:
            places |= {"layer": np.array(layer_names(self.scene), dtype=TEXT), "particle_layer": self.lattice.material}
        return places | self._receptor_coordinates() if self.scene.receptor else places

    def _receptor_coordinates(self) -> dict[str, NDArray[Any]]:
        return {
            "receptor": np.array([receptor.name for receptor in self.scene.receptor], dtype=TEXT),
            "receptor_x": self.stretches.mean(axis=1),
            "receptor_x_bounds": self.stretches,
        }

    @cached_property
    def boxes(self) -> BoxMap:
        """The boxes over which the random field is averaged for the records."""
        return box_map(self.model.surface, self.sampler.grid)

    @property
    def stretches(self) -> Array:
        """Near and far end in m of each receptor, (r, 2)."""
        return np.array([receptor.x for receptor in self.scene.receptor]).reshape(-1, 2)

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """What a realization's record holds, by name."""
        return with_dims(QUANTITIES, sizes(self))

    @property
    def n_particles(self) -> int:
        """Number of particles."""
        return self.lattice.x.size

    @property
    def toe_x(self) -> float:
        """Place of the initial toe in m."""
        return self.model.surface.toe_x

    def strengths(self, realization: int) -> "xr.Dataset":
        """Return the random soil properties of a realization on the reference grid of the random field.

        Parameters
        ----------
        realization : int
            Its id, 0 or more; -1 for mean strengths everywhere.

        Returns
        -------
        xarray.Dataset
            `cohesion` (Pa), `friction_angle` (rad) and what else the scene makes random, each (y, x), with
            coordinates in m; NaN outside the ground where the sampler leaves it out.
        """
        return self.draw(realization).to_dataset()

    def simulate(
        self,
        realization: int,
        interrupt: Callable[[], bool] = never,
        observe: Callable[[March], None] = nothing,
    ) -> Record:
        """Simulate a realization from the release of strength to rest.

        Parameters
        ----------
        realization : int
            Its id, 0 or more; -1 for mean strengths everywhere.
        interrupt : callable
            Asked at every output time whether to leave.
        observe : callable
            Sees the march at every output time.

        Raises
        ------
        campaign.simulation.contract.Interrupted
            If `interrupt` says so.
        campaign.errors.SamplerError
            If the realization has no valid strengths.
        """
        field, times = self.draw(realization), self.coordinates["time"]
        return simulate(
            self.model,
            self._with(field),
            times,
            realization,
            interrupt,
            observe,
            receptors=self.stretches,
            field_map=self.boxes.means(field) if self.random_properties else None,
            settled=self.settled if self.scene.numerics.gravity == "ramp" else None,
        )

    def simulate_mean(self) -> Record:
        """Simulate the deterministic run, with mean strengths everywhere."""
        return self.simulate(BASELINE)

    def draw(self, realization: int) -> Strengths:
        """Draw the strengths of a realization on the reference grid."""
        return self.sampler.draw(self.scene.campaign.seed, realization)

    @property
    def random_properties(self) -> tuple[SoilProperty, ...]:
        """What the scene makes random."""
        return random_properties(self.scene)

    def particles_of_layers(self, *names: str) -> list[NDArray[np.bool_]]:
        """Return the mask (n,) of the particles of each layer in which some properties are random."""
        return [is_here for layer, is_here in self._layers() if marginals(layer).keys() >= {*names}]

    def is_random(self, name: str) -> NDArray[np.bool_]:
        """Return the mask (n,) of the particles at which a property is random."""
        return np.asarray(np.any(self.particles_of_layers(name), axis=0))

    def released(self, realization: int) -> Particles:
        """Return the in-situ state with the soil of a realization; nowhere is peak strength below residual."""
        return self._with(self.draw(realization))

    def _with(self, field: Strengths) -> Particles:
        raised = raised_to_floor(self._soil(field))
        return self.in_situ._replace(**{BY_NAME[name].particle_array: values for name, values in raised.items()})

    def _soil(self, field: Strengths) -> dict[str, Array]:
        """Return all properties at the particles by name, those that are not random too."""
        soil, drawn = {row.name: np.empty(self.n_particles) for row in PROPERTIES}, self._at_particles(field)
        for layer, is_here in self._layers():
            for row in PROPERTIES:
                if (share := row.share_of_peak(layer)) is not None:
                    soil[row.name][is_here] = share * soil[row.peak][is_here]
                else:
                    soil[row.name][is_here] = drawn[row.name][is_here] if row.name in drawn else row.mean(layer)
        return soil

    def raised_shares(self, realization: int) -> dict[str, float]:
        """Return the share of particles at which a drawn peak is below the residual and is raised to it, by name."""
        soil = self._soil(self.draw(realization))
        raised, random = raised_to_floor(soil), self.random_properties
        return {
            row.name: float(np.mean(raised[row.name] > soil[row.name]))
            for row in PROPERTIES
            if row.floor_key and any(each.mean_key in (row.mean_key, row.floor_key) for each in random)
        }

    def _layers(self) -> Iterator[tuple[Scene, NDArray[np.bool_]]]:
        """Yield the scene with the soil of each layer, and the mask of its particles."""
        for number, layer in enumerate(layer_scenes(self.scene)):
            yield layer, self.lattice.material == number

    def _at_particles(self, field: Strengths) -> dict[str, Array]:
        within = np.minimum(self.lattice.x, self.model.surface.width)  # a wall may stand beyond by part of a cell
        return field.at(within, self.lattice.y, self.lattice.material)


def prepare(scene: Scene, directory: Path | None = None) -> Ground:
    """Compute what all realizations of a scene share, the in-situ state above all.

    Parameters
    ----------
    scene : Scene
    directory : Path, optional
        Of the campaign, where the in-situ state and a large factor of the field sampler are kept; without one both are
        held in memory.

    Raises
    ------
    RefusalError
        If the ground does not come to rest under its own weight.
    SamplerError
        If the sampler cannot draw the scene's field.
    """
    model = model_of(scene)
    lattice = wet_ground_of(model)
    is_ramp = scene.numerics.gravity == "ramp"
    with telling_of_compilation(lambda: say(COMPILING)):
        settled = _loaded(model, is_ramp, directory)
    in_situ = _unloaded(lattice) if is_ramp else settled
    return Ground(scene, model, lattice, in_situ, settled, _sampler(scene, model.surface, directory))


def prepare_to_run(scene: Scene, directory: Path) -> Ground:
    """Do the same, and have the solver compiled where the ground was kept: by one process, before all ranks ask for it.

    Arguments and errors are those of `prepare`.
    """
    ground = prepare(scene, directory)
    with telling_of_compilation(lambda: say(COMPILING)):
        March(ground.model, ground.settled)  # which takes no step, but is compiled for any
    return ground


def strengths_of(scene: Scene, realization: int) -> Strengths:
    """Draw the strengths of a realization without preparing anything else."""
    return _sampler(scene, surface_of(scene.geometry), None).draw(scene.campaign.seed, realization)


def _loaded(model: Model, from_nothing: bool, directory: Path | None) -> Particles:
    try:
        return kept_in_situ_state(model, from_nothing, directory)
    except NotSettledError as error:
        raise RefusalError(str(error)) from error


def _unloaded(lattice: Particles) -> Particles:
    """Return the particles before gravity acts: neither stress nor pore pressure."""
    return copy_particles(lattice._replace(pore_pressure=np.zeros_like(lattice.x)))


def _sampler(scene: Scene, surface: Surface, directory: Path | None) -> StrengthSampler:
    return strength_sampler(scene, surface.width, surface.top, directory, soil=lambda x, y: y < surface.height_at(x))
