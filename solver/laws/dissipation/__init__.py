"""Dissipation laws: what the rate adds in a contact; one file a law, this registry names them."""

from jointplay.solver.laws.dissipation.exact import Exact
from jointplay.solver.laws.dissipation.flores import Flores
from jointplay.solver.laws.dissipation.gharib_hurmuzlu import GharibHurmuzlu
from jointplay.solver.laws.dissipation.gonthier import Gonthier
from jointplay.solver.laws.dissipation.herbert_mcwhannell import HerbertMcWhannell
from jointplay.solver.laws.dissipation.hu_guo import HuGuo
from jointplay.solver.laws.dissipation.hunt_crossley import HuntCrossley
from jointplay.solver.laws.dissipation.hunt_crossley_unlatched import HuntCrossleyUnlatched
from jointplay.solver.laws.dissipation.jankowski import Jankowski
from jointplay.solver.laws.dissipation.kelvin_voigt import KelvinVoigt
from jointplay.solver.laws.dissipation.kuwabara_kono import KuwabaraKono
from jointplay.solver.laws.dissipation.lankarani_nikravesh import LankaraniNikraveshDamping
from jointplay.solver.laws.dissipation.law import Dissipation, Elastic
from jointplay.solver.laws.dissipation.lee_wang import LeeWang
from jointplay.solver.laws.dissipation.none import NoDissipation
from jointplay.solver.laws.dissipation.safaeifar_farshidianfar import SafaeifarFarshidianfar
from jointplay.solver.laws.dissipation.tsuji import Tsuji
from jointplay.solver.laws.dissipation.zhiying_qishao import ZhiyingQishao

LAWS: dict[str, type[Dissipation]] = {
    "exact": Exact,
    "none": NoDissipation,
    "kelvin-voigt": KelvinVoigt,
    "hunt-crossley": HuntCrossley,
    "hunt-crossley-unlatched": HuntCrossleyUnlatched,
    "herbert-mcwhannell": HerbertMcWhannell,
    "lee-wang": LeeWang,
    "lankarani-nikravesh": LankaraniNikraveshDamping,
    "gonthier": Gonthier,
    "zhiying-qishao": ZhiyingQishao,
    "flores": Flores,
    "hu-guo": HuGuo,
    "gharib-hurmuzlu": GharibHurmuzlu,
    "safaeifar-farshidianfar": SafaeifarFarshidianfar,
    "jankowski": Jankowski,
    "tsuji": Tsuji,
    "kuwabara-kono": KuwabaraKono,
}

__all__ = ["LAWS", "Dissipation", "Elastic"]
