from tribo_scar.measurement import MeasuredScar as MeasuredScar
from tribo_scar.measurement import measured_scar as measured_scar
from tribo_scar.picture import measured_scar_map as measured_scar_map

__all__: list[str]
