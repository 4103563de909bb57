/// What a list of vertices x0, y0, x1, y1, … says as a polygon: its area, its turn, and why it may be none.
#pragma once

#include <string>
#include <vector>

namespace fpi {

/// Shoelace formula [m²]; positive where the vertices go counter-clockwise.
double signed_area(const std::vector<double>& vertices);

std::vector<double> counter_clockwise(std::vector<double> vertices);

/// "", or what a closed simple polygon must be and this one is not, naming the vertices (from 0).
std::string polygon_problem(const std::vector<double>& vertices);

}  // namespace fpi
