"""How the results of the bench of the coupling are shown: a table and a picture."""

from pathlib import Path

TITLES = {"one": "one disc", "twenty": "20 discs at gaps of 0.2 d and more"}
COST_ASKED = {"one": 1.5, "twenty": 2.0}


def method(row: dict) -> str:
    return f"{row['response']} + {row['acceleration']}"


def table(key: str, result: dict) -> str:
    lines = [f"{TITLES[key] + ': density ratio':44s}{'response + acceleration':24s}{'mean':>6s}{'asked':>7s}{'most':>6s}"
             f"{'first':>6s}{'solves':>8s}{'factors':>8s}{'s/step':>8s}{'error':>9s}{'shift/h':>8s}"]
    for row in result["methods"]:
        start = f"{row['density_ratio']:44g}".lstrip().ljust(44) + f"{method(row):24s}"
        if row["status"] != "completed":
            lines.append(f"{start}{'-':>6s}{row['asked']:7g}  does not converge")
            continue
        lines.append(f"{start}{row['mean']:6.2f}{row['asked']:7g}{row['most']:6.0f}{row['first']:6.0f}{row['solves']:8.1f}"
                     f"{row['factorisations']:8.2f}{row['seconds']:8.3f}{row['error']:9.1e}{row['shift']:8.2f}")
    cost = result["cost"]
    lines.append(f"a coupled step takes {cost['ratio']:.2f} times one with given motion (asked: {COST_ASKED[key]}): "
                 f"{cost['coupled']['seconds']:.3f} and {cost['prescribed']['seconds']:.3f} s")
    return "\n".join(lines) + "\n"


def draw(results: dict, path: Path) -> None:
    """Mean sub-iterations against the density ratio, a line a method."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(results), figsize=(6 * len(results), 5), squeeze=False)
    for axis, (key, result) in zip(axes[0], results.items()):
        done = [row for row in result["methods"] if row["status"] == "completed"]
        for name in dict.fromkeys(method(row) for row in result["methods"]):
            points = [(row["density_ratio"], row["mean"]) for row in done if method(row) == name]
            axis.plot(*zip(*points) if points else ([], []), marker="o", label=name)
        asked = sorted({(row["density_ratio"], row["asked"]) for row in result["methods"]})
        axis.plot(*zip(*asked), color="grey", linestyle=":", label="asked")
        axis.set_xscale("symlog", linthresh=0.01)
        axis.set(title=TITLES[key], xlabel="density ratio", ylabel="mean sub-iterations")
        axis.grid(alpha=0.3)
        axis.legend(fontsize="small")
    figure.tight_layout()
    figure.savefig(path, dpi=130)
