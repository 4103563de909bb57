#include "results/statistics.hpp"

#include <algorithm>

namespace fpi {

void Statistics::add_step(const Attempt& attempt) {
  ++steps_;
  (steps_ <= steps_left_out ? early_ : late_) += attempt.sub_iterations;
  max_ = std::max(max_, attempt.sub_iterations);
  largest_overlap_ = std::max(largest_overlap_, attempt.largest_overlap);
  recuts_ += attempt.recuts;
  columns_ += static_cast<double>(attempt.columns.kept);
  most_columns_ = std::max<std::uint64_t>(most_columns_, attempt.columns.kept);
  dropped_ += attempt.columns.dropped;
  displacement_ = std::max(displacement_, attempt.displacement);
  miss_ = std::max(miss_, attempt.miss);
  if (attempt.sub_iterations <= attempt.recuts + 1) return;  // every guess came true: none was the worst
  const auto unknown = static_cast<std::size_t>(attempt.worst);
  if (worst_.size() <= unknown) worst_.resize(unknown + 1);
  ++worst_[unknown];
}

void Statistics::add_stalls(const Attempt& attempt) {
  for (const coupling::StallEvent& event : attempt.stalls)
    ++remedies_.at(static_cast<std::size_t>(event.remedy));
}

double Statistics::mean_sub_iterations() const {
  if (steps_ == 0) return 0;
  const bool few = steps_ <= steps_left_out;
  return static_cast<double>(few ? early_ : late_) /
         static_cast<double>(few ? steps_ : steps_ - steps_left_out);
}

std::optional<Statistics::Worst> Statistics::worst() const {
  const auto found = std::ranges::max_element(worst_);
  if (found == worst_.end()) return std::nullopt;
  return Worst{found - worst_.begin(), *found};
}

template <class Visit>
void Statistics::each_number(Visit visit) {
  for (std::uint64_t* count : {&steps_, &early_, &late_, &rejected_, &repeated_, &recuts_, &most_columns_,
                               &dropped_, &remedies_[0], &remedies_[1], &remedies_[2]})
    visit(*count);
  visit(max_);
  for (double* value : {&largest_overlap_, &columns_, &displacement_, &miss_}) visit(*value);
  for (std::uint64_t& count : worst_) visit(count);
}

std::vector<double> Statistics::numbers() const {
  std::vector<double> numbers{static_cast<double>(worst_.size())};
  Statistics(*this).each_number([&](auto& value) { numbers.push_back(static_cast<double>(value)); });
  return numbers;
}

void Statistics::set_numbers(const std::vector<double>& numbers) {
  worst_.resize(static_cast<std::size_t>(numbers.at(0)));
  std::size_t next = 1;
  each_number([&]<class T>(T& value) { value = static_cast<T>(numbers.at(next++)); });
}

}  // namespace fpi
