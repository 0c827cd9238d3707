"""What every method and tolerance costs and buys, on every preset that integrates anything."""

from jointplay.command_line.accuracy import table
from solver import presets
from solver.admission import admit
from solver.assembly import assemble
from solver.scene.document import Scene
from solver.trade.advice import advice
from solver.trade.measure import measure

WITHOUT_PERIOD = 1.0  # s, of presets without drivers


def main() -> None:
    for name in presets.names():
        job = {"kind": "simulate", "scene": {"preset": name}}
        admission = admit(job | {"duration": WITHOUT_PERIOD})
        if assemble(Scene.model_validate(admission.scene)).freedom_with_play == 0:
            continue
        if admission.period is not None:
            admission = admit(job | {"duration": admission.period})
        trade = measure(admission, lambda fraction, note: None)
        print(f"\n### {name}\n")
        print(table(trade))
        print(advice(trade))


if __name__ == "__main__":
    main()
