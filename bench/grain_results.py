"""How the results of the bench of grains are shown: tables and a picture."""

from pathlib import Path


def throughput_table(case: str, rows: list[dict]) -> str:
    ours = rows[0]["million_steps_per_second"]
    lines = [f"{case + ' (' + str(rows[0]['steps']) + ' steps)':34s}{'M steps/s':>10s}{'fpi / it':>10s}{'MB':>8s}"]
    lines += [f"{row['program']:34s}{row['million_steps_per_second']:10.2f}{ours / row['million_steps_per_second']:10.2f}"
              f"{row['megabytes']:8.0f}" for row in rows]
    return "\n".join(lines)


def impact_table(rows: list[dict]) -> str:
    lines = [f"{'impact without damping, error of':34s}{'step':>10s}{'time':>10s}{'speed':>10s}"]
    lines += [f"{row['program']:34s}{'t_c/' + str(row['steps_per_contact']):>10s}{row['contact_time']:10.1e}"
              f"{row['restitution']:10.1e}" for row in rows]
    return "\n".join(lines)


def draw(results: dict, path: Path) -> None:
    """Throughput as bars, a group a case; errors of impacts against steps in a contact."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (speed, error) = pyplot.subplots(1, 2, figsize=(13, 5), width_ratios=(2, 1))
    cases = results["throughput"]
    names = list(dict.fromkeys(row["program"] for rows in cases.values() for row in rows))
    width = 0.8 / max(len(names), 1)
    for i, name in enumerate(names):
        bars = [(k + (i - len(names) / 2 + 0.5) * width, row["million_steps_per_second"])
                for k, rows in enumerate(cases.values()) for row in rows if row["program"] == name]
        speed.bar(*zip(*bars), width, label=name)
    speed.set(yscale="log", ylabel="million grain steps a second, one core", xticks=range(len(cases)), xticklabels=cases)
    speed.grid(axis="y", which="both", alpha=0.3)
    speed.legend(fontsize="small")
    for name in dict.fromkeys(row["program"] for row in results["impacts"]):
        rows = [row for row in results["impacts"] if row["program"] == name]
        error.loglog([row["steps_per_contact"] for row in rows], [max(row["contact_time"], 1e-16) for row in rows],
                     marker="o", label=name)
    error.set(xlabel="steps in the contact time of Hertz", ylabel="relative error of the contact time")
    error.grid(which="both", alpha=0.3)
    error.legend(fontsize="small")
    figure.tight_layout()
    figure.savefig(path, dpi=130)
