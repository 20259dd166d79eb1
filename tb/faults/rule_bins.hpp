// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RuleBins: the functional coverage that rule TH-05 asks for, counted bit by bit.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/node_model.hpp"

namespace vericansim {

/// T, R, or - for neither.
[[nodiscard]] const char *role_name(Role role);

/// One cross of TH-05: its bins by key, and what is left out of it and why.
struct BinGroup {
  struct Bin {
    std::string name;
    std::uint64_t hits = 0;
  };

  std::string name;
  std::map<std::uint32_t, Bin> bins;     ///< all that can be reached
  std::vector<std::string> unreachable;  ///< what the product also holds, each with the reason
  std::map<std::uint32_t, std::uint64_t> unlisted;  ///< hits of what is called unreachable

  void add(std::uint32_t key, std::string text) { bins[key].name = std::move(text); }
  void hit(std::uint32_t key, std::uint64_t times = 1);
  [[nodiscard]] std::size_t reached() const;
};

/// Watches one node. The place, role and state of a bit are those of the rule model that follows
/// the node, so call before() and after() around the model's sample() of each bit.
class RuleBins {
 public:
  /// The crosses, in the order of TH-05.
  enum Cross : std::uint8_t {
    kInversion,
    kInt3Sof,
    kLateDominant,
    kLoss,
    kSync,
    kCounter,
    kCrosses
  };

  RuleBins();

  /// A new run begins: nothing is known of what went before.
  void begin();
  /// A bit is about to be sampled: level of the wire and as the node sees it.
  void before(const NodeModel &model, Level wire, Level seen);
  /// The model has taken it.
  void after(const NodeModel &model);
  /// The sweep SY-19 has checked an edge with phase error `e` (quanta).
  void sync(int e, unsigned sjw, bool transmitter, Level sent);

  [[nodiscard]] const std::vector<BinGroup> &groups() const { return groups_; }
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::size_t reached() const;
  /// Adds the counts of another thread.
  void merge(const RuleBins &other);
  /// Adds hits of one bin of a cross (Cross), from a file. Throws std::out_of_range if there is no
  /// such cross.
  void add(std::size_t cross, std::uint32_t key, std::uint64_t hits);

 private:
  /// What the running flag or delimiter belongs to.
  enum class Context : std::uint8_t { kNone, kActive, kPassive, kOverload };

  void count_inversion(Level wire, Level seen);
  void count_loss(const NodeModel &model);
  void count_counters(const NodeModel &model);
  void follow_story(const NodeModel &model);
  [[nodiscard]] unsigned story() const;

  std::vector<BinGroup> groups_;
  // of the bit under way
  BitPlace place_;
  Role role_ = Role::kNone;
  bool passive_ = false;
  bool after_stuff_ = false;  // the bit before was a stuff bit
  int tec_ = 0;
  int rec_ = 0;
  // of the frame
  Context context_ = Context::kNone;
  bool lost_ = false;
  bool error_ = false;
  bool overload_ = false;
};

/// The crosses with all their bins, none hit: what can be reached by the rules.
[[nodiscard]] BinGroup inversion_bins();
[[nodiscard]] BinGroup int3_bins();
[[nodiscard]] BinGroup late_dominant_bins();
[[nodiscard]] BinGroup loss_bins();
[[nodiscard]] BinGroup sync_bins();
[[nodiscard]] BinGroup counter_bins();

/// Keys of the bins; each argument is small.
namespace bin_key {
[[nodiscard]] std::uint32_t inversion(Role role, bool passive, const BitPlace &place,
                                      unsigned context, Level seen);
[[nodiscard]] std::uint32_t int3(bool pending, bool passive, unsigned story);
[[nodiscard]] std::uint32_t late(Field field, unsigned context, Role role, bool passive,
                                 unsigned index);
[[nodiscard]] std::uint32_t loss(bool extended, unsigned position, unsigned relation);
[[nodiscard]] std::uint32_t sync(int e, unsigned sjw, bool transmitter, Level sent);
[[nodiscard]] std::uint32_t counter(unsigned kind, unsigned threshold, unsigned from);
}  // namespace bin_key

/// Relations of a lost bit to a stuff bit, and kinds of counter steps.
enum LossRelation : std::uint8_t { kLossPlain, kLossAfterStuff, kLossAtStuff, kLossBeforeStuff };
enum CounterStep : std::uint8_t {
  kTecUp8,
  kTecDown1,
  kTecRecovered,
  kRecUp1,
  kRecUp8,
  kRecDown1,
  kRecSetBack
};

}  // namespace vericansim
