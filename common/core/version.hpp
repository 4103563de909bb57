#pragma once

namespace fpi {
inline constexpr const char* version = "0.1.0";
}
