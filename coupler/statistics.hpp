/// Counts over the accepted steps of a run. Means leave out the first five steps where there are more, since
/// those start without history.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace fpi {

class Statistics {
 public:
  static constexpr std::uint64_t steps_left_out = 5;

  void add_step(std::uint32_t sub_iterations, double overlap) {
    ++steps_;
    (steps_ <= steps_left_out ? early_ : late_) += sub_iterations;
    max_ = std::max(max_, sub_iterations);
    largest_overlap_ = std::max(largest_overlap_, overlap);
  }

  std::uint64_t steps() const { return steps_; }
  std::uint32_t max_sub_iterations() const { return max_; }
  double largest_overlap() const { return largest_overlap_; }  ///< [m]
  double mean_sub_iterations() const {
    if (steps_ == 0) return 0;
    const bool few = steps_ <= steps_left_out;
    return static_cast<double>(few ? early_ : late_) /
           static_cast<double>(few ? steps_ : steps_ - steps_left_out);
  }

  std::vector<double> numbers() const {
    return {static_cast<double>(steps_), static_cast<double>(early_), static_cast<double>(late_),
            static_cast<double>(max_), largest_overlap_};
  }
  void set_numbers(const std::vector<double>& numbers) {
    steps_ = static_cast<std::uint64_t>(numbers.at(0));
    early_ = static_cast<std::uint64_t>(numbers.at(1));
    late_ = static_cast<std::uint64_t>(numbers.at(2));
    max_ = static_cast<std::uint32_t>(numbers.at(3));
    largest_overlap_ = numbers.at(4);
  }

 private:
  std::uint64_t steps_ = 0, early_ = 0,
                late_ = 0;  ///< early_, late_: sub-iterations of the first five and the rest
  std::uint32_t max_ = 0;
  double largest_overlap_ = 0;
};

}  // namespace fpi
