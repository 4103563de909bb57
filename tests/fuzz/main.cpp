/// Drives a fuzz target without libFuzzer. Inputs run in a child process; where it dies or hangs, the input
/// is kept in a file and the next child goes on behind it.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <new>

#include "core/pages.hpp"
#include "mutator.hpp"

namespace fpi::fuzz {
namespace {

constexpr unsigned patience = 20;           ///< [s] for one input
constexpr rlim_t most_memory = 4ull << 30;  ///< [bytes] of a child
constexpr std::uint64_t most_faults = 10;   ///< after which a run ends

struct Options {
  std::uint64_t count = 10000, first = 1;  ///< numbers of the inputs
  std::string seeds_folder;
  std::vector<std::filesystem::path> inputs;  ///< to replay instead
};

void usage(const char* program) {
  std::fprintf(stderr,
               "usage: %s [--count N] [--first N]   mutated inputs of these numbers (default 10000, from 1)\n"
               "       %s FILE ...                  these inputs\n"
               "       %s --write-seeds DIR         the seeds as files, a corpus for libFuzzer\n",
               program, program, program);
  std::exit(2);
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (!word.starts_with("--")) {
      options.inputs.emplace_back(word);
      continue;
    }
    if (++i == argc) usage(argv[0]);
    if (word == "--write-seeds") {
      options.seeds_folder = argv[i];
    } else if (word == "--count") {
      options.count = std::strtoull(argv[i], nullptr, 10);
    } else if (word == "--first") {
      options.first = std::strtoull(argv[i], nullptr, 10);
    } else {
      usage(argv[0]);
    }
  }
  return options;
}

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) fault("cannot write " + path.string());
}

/// Of the input that runs; parent and child see it.
using Number = std::atomic<std::uint64_t>;

Number* shared_number() {
  void* page = mmap(nullptr, sizeof(Number), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) fault("no shared memory");
  return new (page) Number(0);
}

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const rlimit limit{most_memory, most_memory};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

/// All inputs from *number on to the last; *number says which one runs.
template <class Input>
[[noreturn]] void run_child(Number* number, std::uint64_t end, Input input) {
  limit_memory();
  keep_pages();  // as the programs do
  for (; *number < end; ++*number) {
    const Bytes bytes = input(number->load());
    alarm(patience);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::fflush(nullptr);
  _exit(0);
}

std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ended with status {}", WEXITSTATUS(status));
  return WTERMSIG(status) == SIGALRM ? fmt::format("took more than {} s", patience)
                                     : fmt::format("died of {}", strsignal(WTERMSIG(status)));
}

/// Runs the inputs [first, end); true where none of them did harm.
template <class Input>
bool run(const std::string& target, std::uint64_t first, std::uint64_t end, Input input) {
  Number* number = shared_number();
  std::uint64_t faults = 0;
  for (*number = first; *number < end && faults < most_faults; ++*number) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) run_child(number, end, input);
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) fault("no child process");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    ++faults;
    const std::string kept = fmt::format("{}-{}", target, number->load());
    write(kept, input(number->load()));
    std::fprintf(stderr, "input %llu %s; it is kept in %s\n", static_cast<unsigned long long>(number->load()),
                 how_it_ended(status).c_str(), kept.c_str());
  }
  return faults == 0;
}

bool replay(const std::string& target, const std::vector<std::filesystem::path>& paths) {
  return run(target, 0, paths.size(), [&paths](std::uint64_t i) {
    std::ifstream file(paths[i], std::ios::binary);
    if (!file) fault("cannot read " + paths[i].string());
    return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  });
}

void write_seeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::size_t number = 0;
  for (const Bytes& seed : seeds()) write(folder / fmt::format("seed-{:03}", number++), seed);
}

bool mutate(const std::string& target, const Options& options) {
  const std::vector<Bytes> all = seeds();
  if (all.empty()) fault("no seeds: the files that they come from are not there");
  const bool seeds_good = run(target + "-seed", 0, all.size(), [&all](std::uint64_t i) { return all[i]; });
  Mutator mutator(all, words());
  const bool good = run(target, options.first, options.first + options.count,
                        [&mutator](std::uint64_t number) { return mutator.input(number); });
  return seeds_good && good;
}

}  // namespace
}  // namespace fpi::fuzz

int main(int argc, char** argv) {
  using namespace fpi::fuzz;
  const Options options = read_options(argc, argv);
  const std::string target = std::filesystem::path(argv[0]).filename();
  if (!options.seeds_folder.empty()) {
    write_seeds(options.seeds_folder);
    return 0;
  }
  return (options.inputs.empty() ? mutate(target, options) : replay(target, options.inputs)) ? 0 : 1;
}
