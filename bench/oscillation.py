"""Extrema and frequency of a settled oscillation from its samples, alike for every program."""


def extrema(times: list[float], values: list[float], sign: int) -> list[tuple[float, float]]:
    """Time and height of each peak (sign 1) or trough (-1), by the parabola through three samples."""
    found = []
    for i in range(1, len(values) - 1):
        a, b, c = (sign * value for value in values[i - 1:i + 2])
        if a < b >= c:
            shift = 0.5 * (a - c) / (a - 2 * b + c)
            step = 0.5 * (times[i + 1] - times[i - 1])
            found.append((times[i] + shift * step, sign * (b - 0.25 * (a - c) * shift)))
    return found


def shedding(series: list[list[float]], start: float, length: float, velocity: float) -> dict[str, float]:
    """Mean extrema of drag, mean peak-to-peak lift and Strouhal number of [time, drag, lift] from `start` on."""
    times, drag, lift = zip(*(row for row in series if row[0] >= start - 1e-9))
    tops, bottoms = extrema(times, lift, 1), extrema(times, lift, -1)
    if len(tops) < 2 or not bottoms:
        return {}

    def mean(points):
        return sum(value for _, value in points) / len(points)

    period = (tops[-1][0] - tops[0][0]) / (len(tops) - 1)
    return {"cd_max": mean(extrema(times, drag, 1)), "cd_min": mean(extrema(times, drag, -1)),
            "cl_range": mean(tops) - mean(bottoms), "St": length / (velocity * period)}
