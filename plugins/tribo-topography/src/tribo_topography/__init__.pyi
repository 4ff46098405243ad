from tribo_topography.config import MeasuredFile as MeasuredFile
from tribo_topography.facts import Facts as Facts
from tribo_topography.facts import describe as describe
from tribo_topography.roughness import Roughness as Roughness
from tribo_topography.running_in import worn_roughness as worn_roughness
from tribo_topography.surface import MeasuredSurface as MeasuredSurface

__all__: list[str]
