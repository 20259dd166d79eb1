// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Many flips: see campaign.hpp. fork() is the snapshot: a child has the whole bus as it is.
#include "softerror/campaign.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "softerror/wave.hpp"

namespace vericansim {
namespace {

// Every flip-flop so many times, each round spread over so many moments.
constexpr unsigned kRounds = 20;
constexpr unsigned kJobsPerRound = 24;
constexpr unsigned kRamFlipsPerJob = 8;
// Added to a seed it gives another moment of the same scene.
constexpr std::uint64_t kOtherMoment = std::uint64_t{kScenes} * 5'000;

/// What a child hands back.
struct Shared {
  Outcome outcome;
  Reference reference;
};

Shared &shared() {
  static Shared *page = [] {
    void *at =
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw std::runtime_error("no shared memory");
    return static_cast<Shared *>(at);
  }();
  return *page;
}

Outcome in_child(World &world, const Flip &flip, const std::string &wave = {}) {
  Shared &page = shared();
  page.outcome = {};
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process for a flip");
  if (child == 0) {
    const auto file = wave.empty() ? nullptr : open_wave(world, wave, flip.index);
    const Outcome outcome = experiment(world, flip, page.reference);
    close_wave(world, file);
    page.outcome = outcome;
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0 || !page.outcome.finished) {
    throw std::runtime_error("the simulation of a flip died: kind " +
                             std::to_string(static_cast<int>(flip.kind)) + ", index " +
                             std::to_string(flip.index));
  }
  return page.outcome;
}

void run_worker(const std::vector<Job> &jobs, unsigned first, unsigned step,
                const std::string &path) {
  std::ofstream out(path, std::ios::binary);
  auto told = std::chrono::steady_clock::now();
  for (std::size_t n = first; n < jobs.size(); n += step) {
    for (const Record &record : run_job(jobs[n]))
      out.write(reinterpret_cast<const char *>(&record), sizeof record);
    const auto now = std::chrono::steady_clock::now();
    if (first == 0 && now - told > std::chrono::seconds(10)) {
      told = now;
      std::printf("softerror: %zu of %zu moments\n", n + 1, jobs.size());
      std::fflush(stdout);
    }
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace

std::vector<Job> plan_jobs(std::uint64_t seed, double share) {
  const auto flops = static_cast<unsigned>(FlopNode::flops().size());
  const auto count = static_cast<unsigned>(std::ceil(share * kRounds * kJobsPerRound));
  std::vector<unsigned> order(flops);
  std::iota(order.begin(), order.end(), 0u);
  std::vector<Job> jobs;
  for (unsigned n = 0; n < count; ++n) {
    const unsigned part = n % kJobsPerRound;
    if (part == 0) {
      for (unsigned i = flops - 1; i > 0; --i)
        std::swap(order[i], order[mix(mix(seed * kRounds + n) + i) % (i + 1)]);
    }
    Job job;
    job.seed = seed * 100'000 + n;
    for (unsigned i = part; i < flops; i += kJobsPerRound)
      job.flips.push_back({Flip::Kind::kFlop, order[i]});
    for (unsigned i = 0; i < kRamFlipsPerJob; ++i) {
      const auto bit = mix(mix(job.seed) + i) % FlopNode::ram_bits();
      job.flips.push_back({Flip::Kind::kRam, static_cast<std::uint32_t>(bit)});
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

namespace {

/// A run without a flip that is not as it should be.
struct UncleanScene : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::vector<Record> run_moment(const Job &job) {
  World world(job.seed);
  const std::uint64_t span = world.window_end() - world.window_begin();
  const std::uint64_t time = job.time.value_or(world.window_begin() + mix(job.seed + 99) % span);
  if (time < world.clock()) throw std::runtime_error("the time lies before the scene");
  world.run(time - world.clock());
  Outcome reference = in_child(world, {});
  const std::string wrong = complaint(reference);
  if (!wrong.empty()) {
    throw UncleanScene("seed " + std::to_string(job.seed) + " without a flip: " + wrong);
  }
  std::vector<Record> records;
  for (const Flip &flip : job.flips) {
    Record record;
    record.outcome = in_child(world, flip, job.wave);
    record.outcome.seed = job.seed;
    record.verdict = judge(record.outcome, reference);
    records.push_back(record);
  }
  return records;
}

}  // namespace

// Two disturbances in the last bits of a frame may lose it (VA-03), without any flip. Then another
// moment of the same scene is taken; only there can that be.
std::vector<Record> run_job(const Job &job) {
  try {
    return run_moment(job);
  } catch (const UncleanScene &) {
    if (job.time || static_cast<Scene>(job.seed % kScenes) != Scene::kErrors) throw;
    Job other = job;
    other.seed += kOtherMoment;
    return run_moment(other);
  }
}

std::vector<Record> run_jobs(const std::vector<Job> &jobs, unsigned processes,
                             const std::string &scratch) {
  const auto path = [&scratch](unsigned n) {
    return scratch + "/softerror-" + std::to_string(getpid()) + "-" + std::to_string(n) + ".bin";
  };
  std::vector<std::string> paths;
  std::vector<pid_t> workers;
  for (unsigned n = 0; n < processes; ++n) {
    paths.push_back(path(n));
    std::fflush(nullptr);
    const pid_t worker = fork();
    if (worker < 0) throw std::runtime_error("no process for a worker");
    if (worker == 0) {
      try {
        run_worker(jobs, n, processes, paths[n]);
        _exit(0);
      } catch (const std::exception &error) {
        std::fprintf(stderr, "softerror: %s\n", error.what());
        _exit(1);
      }
    }
    workers.push_back(worker);
  }
  bool good = true;
  for (const pid_t worker : workers) {
    int status = 0;
    waitpid(worker, &status, 0);
    good = good && status == 0;
  }
  const std::vector<Record> records = good ? read_records(paths) : std::vector<Record>{};
  for (const std::string &name : paths) std::remove(name.c_str());
  if (!good) throw std::runtime_error("a worker failed");
  return records;
}

void write_records(const std::vector<Record> &records, const std::string &path) {
  const std::string unfinished = path + ".new";
  std::ofstream out(unfinished, std::ios::binary);
  for (const Record &record : records)
    out.write(reinterpret_cast<const char *>(&record), sizeof record);
  out.close();
  if (!out || std::rename(unfinished.c_str(), path.c_str()) != 0)
    throw std::runtime_error("cannot write " + path);
}

std::vector<Record> read_records(const std::vector<std::string> &paths) {
  std::vector<Record> records;
  for (const std::string &path : paths) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + path);
    Record record;
    while (in.read(reinterpret_cast<char *>(&record), sizeof record)) records.push_back(record);
    if (in.gcount() != 0) throw std::runtime_error(path + " ends within a record");
  }
  // A job's records are in one file; the order does not tell how many files there were.
  std::stable_sort(records.begin(), records.end(), [](const Record &a, const Record &b) {
    return a.outcome.seed % kOtherMoment < b.outcome.seed % kOtherMoment;
  });
  return records;
}

}  // namespace vericansim
