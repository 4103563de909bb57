/// Mutations of good inputs, bytes or text: the same number gives the same input on every machine.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "fuzz.hpp"

namespace fpi::fuzz {

class Mutator {
 public:
  /// At least one of `seeds` is required.
  Mutator(std::vector<Bytes> seeds, std::vector<std::string> words);
  /// A seed with one to eight changes.
  Bytes input(std::uint64_t number);

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }
  template <class T>
  const T& any(const std::vector<T>& items) {
    return items[below(items.size())];
  }
  /// A piece of a seed of up to 64 bytes.
  Bytes piece();
  void change(Bytes& bytes);
  void change_bytes(Bytes& bytes);
  void change_text(Bytes& bytes);

  std::vector<Bytes> seeds_;
  std::vector<std::string> words_;
  std::mt19937_64 random_;
};

}  // namespace fpi::fuzz
