// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Shard: what a stage of the campaign does of itself when it is cut into shards (docs/cluster.md).
// tb/shards.py is the same for programs in Python.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace vericansim {

/// CAMPAIGN_SHARD: "K/N": the work of shard K of N, whose results go to a file in the stage's
/// directory; "merge/N": the figures from these files; unset: all of it at once.
class Shard {
 public:
  /// From the environment. Throws std::runtime_error if the variable is none of these.
  Shard() {
    const char *variable = std::getenv("CAMPAIGN_SHARD");  // NOLINT(concurrency-mt-unsafe)
    const std::string text = variable == nullptr ? "" : variable;
    if (text.empty()) return;
    const std::size_t slash = text.find('/');
    const std::string what = text.substr(0, slash);
    count_ = slash == std::string::npos ? 0 : number(text.substr(slash + 1));
    merge_ = what == "merge";
    part_ = !merge_ && what.find_first_not_of("0123456789") == std::string::npos;
    number_ = part_ ? number(what) : 0;
    if (count_ == 0 || (part_ && number_ >= count_) || (!part_ && !merge_))
      throw std::runtime_error("CAMPAIGN_SHARD is '" + text +
                               "'; allowed: K/N with K below N, and merge/N");
  }

  /// True: the work of shard number() of count() alone.
  [[nodiscard]] bool part() const { return part_; }
  /// True: no work, but what the shards have left.
  [[nodiscard]] bool merge() const { return merge_; }
  [[nodiscard]] unsigned number() const { return number_; }
  /// Shards in all; 1 if there are none.
  [[nodiscard]] unsigned count() const { return count_; }

  /// The file of this shard below `directory`, in a folder that is made.
  [[nodiscard]] std::string path(const std::string &directory) const {
    return path(directory, number_);
  }
  /// Those of all shards, in order. Throws std::runtime_error if one is missing.
  [[nodiscard]] std::vector<std::string> paths(const std::string &directory) const {
    std::vector<std::string> all;
    for (unsigned n = 0; n < count_; ++n) {
      all.push_back(path(directory, n));
      if (!std::filesystem::exists(all.back()))
        throw std::runtime_error("merge: the results of a shard are missing: " + all.back());
    }
    return all;
  }

 private:
  static unsigned number(const std::string &text) {
    const bool good = !text.empty() && text.size() < 8 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
    return good ? static_cast<unsigned>(std::stoul(text)) : 0;
  }
  [[nodiscard]] std::string path(const std::string &directory, unsigned n) const {
    const std::string folder = directory + "/shards";
    std::filesystem::create_directories(folder);
    return folder + "/" + std::to_string(n) + "-of-" + std::to_string(count_) + ".data";
  }

  bool part_ = false;
  bool merge_ = false;
  unsigned number_ = 0;
  unsigned count_ = 1;
};

}  // namespace vericansim
