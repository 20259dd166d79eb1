// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults: participants that change what receivers see, cut nodes off or detune clocks.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "bus/fault_log.hpp"
#include "bus/node.hpp"
#include "bus/trace.hpp"
#include "bus/types.hpp"

namespace vericansim {

class Bus;

/// "Receiver" index that stands for the observation point of the bus.
inline constexpr NodeId kBusPoint = std::numeric_limits<NodeId>::max();
/// "Every node", where a fault names its victim.
inline constexpr NodeId kAllNodes = kBusPoint - 1;

/// What a fault does to the level that arrives at a receiver.
enum class Effect : std::uint8_t { kFlip, kDominant, kRecessive };

constexpr Level apply_effect(Effect effect, Level level) {
  if (effect == Effect::kFlip) return !level;
  return effect == Effect::kDominant ? Level::kDominant : Level::kRecessive;
}

/// Throws std::invalid_argument unless a bus can have a node `id`, or it is one of the `others`,
/// kAllNodes and kBusPoint: a fault of no node would never take effect.
void require_node(NodeId id, bool others = false);

/// Base of all faults. The kernel asks at every clock edge of every node, and only if a fault
/// exists.
class Fault {
 public:
  /// The functions below that do something; the bus, which has them to call in every clock of every
  /// node, calls no others.
  enum Hook : unsigned { kUnheard = 1, kBabbling = 2, kLevel = 4, kClocked = 8, kAllHooks = 15 };

  virtual ~Fault() = default;
  /// The Hooks that this kind of fault has, always the same.
  [[nodiscard]] virtual unsigned hooks() const { return kAllHooks; }
  /// Called once by Bus::add.
  virtual void attach(Bus &) {}
  /// Bit i set: what node i drives does not reach this receiver.
  [[nodiscard]] virtual std::uint64_t unheard(NodeId, Time) { return 0; }
  /// Bit i set: node i's transmitter is dominant whatever its pin says.
  [[nodiscard]] virtual std::uint64_t babbling(Time) { return 0; }
  /// The level that the receiver gets instead of `level`.
  [[nodiscard]] virtual Level level(NodeId, Time, Level level) { return level; }
  /// A node has been clocked and shows this trace word.
  virtual void clocked(NodeId, Time, std::uint64_t) {}

  /// Where this fault notes when it took effect; it must outlive the fault. Without: nowhere.
  void log_to(FaultLog &log) { log_ = &log; }
  /// The receiver has another level at this clock edge than without the fault. The bus says so of
  /// unheard() and babbling(), level() for itself.
  void took_effect(NodeId receiver, Time t) {
    if (log_ != nullptr && receiver != kBusPoint) log_->mark(t);
  }

 protected:
  [[nodiscard]] FaultLog *log() const { return log_; }

 private:
  FaultLog *log_ = nullptr;
};

/// Forces or flips the level at one receiver (`victim`), or on the whole bus (kAllNodes), for a
/// while. A bus stuck at a level is a window without end.
class LevelFault : public Fault {
 public:
  LevelFault(NodeId victim, Effect effect, Window window)
      : victim_{victim}, effect_{effect}, window_{window} {
    require_node(victim, true);
  }
  [[nodiscard]] unsigned hooks() const override { return kLevel; }
  [[nodiscard]] Level level(NodeId receiver, Time t, Level level) override {
    if ((receiver != victim_ && victim_ != kAllNodes) || !window_.contains(t)) return level;
    const Level changed = apply_effect(effect_, level);
    if (changed != level) took_effect(receiver, t);
    return changed;
  }

 private:
  NodeId victim_;
  Effect effect_;
  Window window_;
};

/// Any number of LevelFaults with an end, for less than one of them costs: windows that are over
/// are not looked at again. Each receiver asks with times that do not go back.
class ScheduledFaults : public Fault {
 public:
  /// `log`: where this one notes when it took effect.
  void add(NodeId victim, Effect effect, Window window, FaultLog *log = nullptr);
  [[nodiscard]] unsigned hooks() const override { return kLevel; }
  [[nodiscard]] Level level(NodeId receiver, Time t, Level level) override;

 private:
  struct Entry {
    Window window;
    Effect effect;
    FaultLog *log;
  };
  struct Receiver {
    std::vector<Entry> entries;  // in the order of their beginnings
    std::size_t head = 0;        // those before are over
  };

  static void insert(Receiver &receiver, const Entry &entry);
  [[nodiscard]] Receiver &receiver(NodeId id);

  Receiver point_;  // the observation point
  std::vector<Receiver> receivers_;
  std::vector<Entry> for_everybody_;  // copied to receivers as they come
};

/// Opens the cable of one node: nobody hears it, and it hears only itself.
class CutFault : public Fault {
 public:
  CutFault(NodeId node, Window window) : node_{node}, window_{window} { require_node(node); }
  [[nodiscard]] unsigned hooks() const override { return kUnheard; }
  [[nodiscard]] std::uint64_t unheard(NodeId receiver, Time t) override {
    if (!window_.contains(t)) return 0;
    const std::uint64_t self = 1ULL << node_;
    return receiver == node_ ? ~self : self;
  }

 private:
  NodeId node_;
  Window window_;
};

/// A transmitter shorted to dominant: it talks all the time, its own receiver included.
class ShortFault : public Fault {
 public:
  ShortFault(NodeId node, Window window) : node_{node}, window_{window} { require_node(node); }
  [[nodiscard]] unsigned hooks() const override { return kBabbling; }
  [[nodiscard]] std::uint64_t babbling(Time t) override {
    return window_.contains(t) ? 1ULL << node_ : 0;
  }

 private:
  NodeId node_;
  Window window_;
};

/// From `when` on the oscillator of a node has another constant error. The node must be on the bus
/// when the fault is added, and the error one that its Clock takes (std::invalid_argument).
class ClockFault : public Fault {
 public:
  ClockFault(NodeId node, Time when, double error_ppm)
      : node_{node}, when_{when}, error_ppm_{error_ppm} {}
  [[nodiscard]] unsigned hooks() const override { return 0; }
  void attach(Bus &bus) override;

 private:
  NodeId node_;
  Time when_;
  double error_ppm_;
};

/// Where a node is in the bit stream, followed clock by clock from its trace. A bit lasts from its
/// boundary to the next; frames are counted from 1 at their SOF or, for a receiver, their ID28.
class PlaceTracker {
 public:
  void clocked(std::uint64_t word);
  [[nodiscard]] Field field() const { return field_; }
  /// Bits of the field that follow the current one.
  [[nodiscard]] unsigned left() const { return left_; }
  /// Bits of the field that came before the current one (stuff bits not counted).
  [[nodiscard]] unsigned index() const { return index_; }
  [[nodiscard]] bool stuff() const { return stuff_; }
  [[nodiscard]] unsigned frame() const { return frame_; }
  /// Clock edges since the bit began: 0 at the edge that ends its first clock.
  [[nodiscard]] unsigned clocks() const { return clocks_; }
  /// True for the first clock of a bit.
  [[nodiscard]] bool fresh() const { return clocks_ == 0; }

 private:
  void enter(std::uint64_t word);

  Field field_ = Field::kInteg;
  unsigned left_ = 0;
  unsigned index_ = 0;
  unsigned frame_ = 0;
  unsigned clocks_ = 0;
  bool stuff_ = false;
  bool ending_ = false;
};

/// A place in the bit stream of one node; an unset member matches anything.
struct PlaceSpec {
  std::optional<unsigned> frame = std::nullopt;  ///< 1 = first frame since the tracker began
  std::optional<Field> field = std::nullopt;
  std::optional<unsigned> index = std::nullopt;  ///< bits of the field before it
  std::optional<unsigned> left = std::nullopt;   ///< bits of the field after it
  std::optional<bool> stuff = std::nullopt;
  unsigned first_clock =
      0;  ///< part of the bit, in clocks of the node: for a quantum q of a prescaler
  unsigned last_clock =
      std::numeric_limits<unsigned>::max();  ///< p these are q * p .. (q + 1) * p - 1

  [[nodiscard]] bool matches(const PlaceTracker &at) const;
};

/// Changes the level while node `watched` is at a place; the victim is `watched` unless told
/// otherwise.
class PlaceFault : public Fault {
 public:
  PlaceFault(NodeId watched, const PlaceSpec &place, Effect effect,
             std::optional<NodeId> victim = {})
      : watched_{watched}, victim_{victim.value_or(watched)}, place_{place}, effect_{effect} {
    require_node(watched);
    require_node(victim_, true);
  }
  [[nodiscard]] unsigned hooks() const override { return kLevel | kClocked; }
  [[nodiscard]] Level level(NodeId receiver, Time t, Level level) override;
  void clocked(NodeId node, Time t, std::uint64_t word) override;
  /// Bits at the place so far, whether the level there was another one or not.
  [[nodiscard]] unsigned hits() const { return hits_; }

 private:
  NodeId watched_;
  NodeId victim_;
  PlaceSpec place_;
  Effect effect_;
  PlaceTracker tracker_;
  bool active_ = false;
  unsigned hits_ = 0;
};

/// Random noise. Both probabilities may be set; each victim has its own stream of random numbers.
struct NoiseConfig {
  double per_bit = 0.0;  ///< probability that a whole bit of a victim is flipped (needs a trace)
  double per_ns = 0.0;   ///< rate of glitches, 1/ns; a glitch flips the level for `glitch`
  Time glitch = 50 * kNanosecond;
  NodeId victim = kAllNodes;
  Window window{};
  std::uint64_t seed = 1;
};

/// Throws std::invalid_argument if a probability is outside 0..1, a glitch does not last, or the
/// victim is no node.
class NoiseFault : public Fault {
 public:
  explicit NoiseFault(const NoiseConfig &config);
  [[nodiscard]] unsigned hooks() const override { return kLevel | kClocked; }
  [[nodiscard]] Level level(NodeId receiver, Time t, Level level) override;
  void clocked(NodeId node, Time t, std::uint64_t word) override;
  /// Flipped bits and glitches drawn so far, whether they were seen or not.
  [[nodiscard]] unsigned hits() const { return hits_; }

 private:
  struct Victim {
    std::mt19937_64 random;
    PlaceTracker tracker;
    Time next_glitch = 0;
    Time glitch_end = 0;
    bool bit_hit = false;
  };

  [[nodiscard]] Victim &victim(NodeId id);
  [[nodiscard]] Time draw_gap(Victim &victim) const;

  NoiseConfig config_;
  std::vector<Victim> victims_;
  unsigned hits_ = 0;
};

}  // namespace vericansim
