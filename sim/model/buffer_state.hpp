// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferState: one possible state of the message buffers, and what each event makes of it
// (flexcan.md 3, 4). It never chooses: where the specification leaves freedom, BufferModel calls it
// once for each possibility.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/buffer_match.hpp"
#include "model/message_buffers.hpp"

namespace vericansim {

/// Reference count of bit times; none: the CPU wrote TIMER meanwhile, and which of the two counts
/// the frame got is open.
using Stamp = std::optional<std::uint16_t>;

/// A frame from the bus, as it comes to the buffers.
struct ArrivedFrame {
  Frame frame;
  Stamp stamp = 0;   ///< at the start of the identifier
  bool own = false;  ///< sent by this node
  friend bool operator==(const ArrivedFrame &, const ArrivedFrame &) = default;
};

/// Where a received frame goes.
struct Destination {
  enum class Kind : std::uint8_t { kUndecided, kNowhere, kMailbox, kAnswer, kFifo, kOverflow };
  Kind kind = Kind::kUndecided;
  unsigned index = 0;  ///< of the buffer, or IDHIT
  friend bool operator==(const Destination &, const Destination &) = default;
};

/// The frame being sent.
struct Flight {
  unsigned mb = 0;
  SendRequest request;
  bool orphan = false;  ///< deactivated since (AEN=0): ends without code or flag
  bool abort = false;   ///< abort requested (AEN=1)
  friend bool operator==(const Flight &, const Flight &) = default;
};

/// A flight that has ended on the wire and not yet in its buffer.
struct FlightEnd {
  Flight flight;
  bool success = false;
  Stamp stamp = 0;
  friend bool operator==(const FlightEnd &, const FlightEnd &) = default;
};

struct FifoEntry {
  ArrivedFrame frame;
  unsigned id_hit = 0;
  friend bool operator==(const FifoEntry &, const FifoEntry &) = default;
};

/// Frames that the FIFO holds (flexcan.md 4).
inline constexpr std::size_t kFifoDepth = 6;

/// IFLAG1 bits of the FIFO.
inline constexpr std::uint64_t kFlagAvailable = 1u << 5;
inline constexpr std::uint64_t kFlagWarning = 1u << 6;
inline constexpr std::uint64_t kFlagOverflow = 1u << 7;

/// One possible state.
class BufferState {
 public:
  explicit BufferState(unsigned num_mb) : mb(num_mb) {}
  friend bool operator==(const BufferState &, const BufferState &) = default;

  // ---- The CPU

  /// A word of a buffer is written, after all checks. `now`: clock.
  void write(unsigned n, unsigned word, std::uint32_t data, std::uint32_t lanes,
             const BufferConfig &config, std::uint64_t now);
  /// AEN=1: C/S writes to this buffer have no effect while it is being sent.
  [[nodiscard]] bool write_blocked(unsigned n) const;
  /// Whether reading this C/S word locks its buffer.
  [[nodiscard]] bool read_locks(unsigned n, const BufferConfig &config) const;
  void lock_for_read(unsigned n);
  /// The frame that may be on its way into buffer n, word by word.
  [[nodiscard]] const ArrivedFrame *on_its_way(unsigned n) const;
  /// That frame has changed a word that the CPU saw, or showed BUSY.
  void show_move(unsigned n) { moving |= std::uint64_t{1} << n; }
  [[nodiscard]] bool move_shown(unsigned n) const { return ((moving >> n) & 1) != 0; }
  /// Ends the lock; `read` marks the buffer as serviced. A waiting frame is released.
  void unlock(bool read, std::uint64_t now);
  /// The released frame has moved in.
  void release();
  /// Abort honoured: 1001 and the flag.
  void abort(unsigned n, std::uint64_t now);
  /// IFLAG is written.
  void clear_flags(std::uint64_t bits, const BufferConfig &config);
  /// FEN has changed, or with FEN=1 RFFN (freeze mode): which buffers are mailboxes. `fifo_too`:
  /// the FIFO is empty then, and what it kept in its buffers is not known.
  void area_changed(bool fifo_too);
  /// The frame under way is matched no longer.
  void end_round();
  void soft_reset();

  // ---- The bus

  /// All places that the matching rules allow for this frame now (more than one only where the
  /// specification leaves it open).
  [[nodiscard]] std::vector<Destination> destinations(const ArrivedFrame &arrived,
                                                      const BufferMasks &masks,
                                                      const BufferConfig &config) const;
  /// The place in the FIFO that became free after the match had found none: a frame that was to be
  /// lost, or to overrun a mailbox, may take it (flexcan.md 4 does not say when room is looked
  /// for).
  [[nodiscard]] std::optional<Destination> late_place(const BufferMasks &masks,
                                                      const BufferConfig &config) const;
  /// The frame is stored where `to` says, or waits there for the unlock.
  void store(const ArrivedFrame &arrived, const Destination &to, std::uint64_t now,
             const BufferConfig &config);
  /// The flight has ended: stamp, code, flag, or back among the candidates.
  void finish(const FlightEnd &end, std::uint64_t now);
  /// Request of the buffer from what is in it now (code 1100 or 1110).
  [[nodiscard]] SendRequest request_of(unsigned n, const BufferConfig &config,
                                       std::uint64_t now) const;
  /// Buffer n is no candidate any more.
  void withdraw(unsigned n, std::uint64_t now);

  /// Equal states have equal digests; different ones nearly always different ones.
  [[nodiscard]] std::uint64_t digest() const;
  /// IFLAG2:IFLAG1 as the CPU reads it; with FEN=1 bits 4 to 0 are unused (1.5).
  [[nodiscard]] std::uint64_t flags(bool fen) const {
    if (!fen) return iflag;
    return (iflag & ~std::uint64_t{0x1F}) | (fifo.empty() ? 0 : kFlagAvailable);
  }

  MessageBuffers mb;
  std::uint64_t iflag = 0;
  std::optional<unsigned> lock;
  std::optional<std::pair<unsigned, ArrivedFrame>> waiting;   ///< for the locked buffer
  std::optional<std::pair<unsigned, ArrivedFrame>> released;  ///< waited, moves in now
  std::uint64_t released_since = 0;
  std::uint64_t moving = 0;     ///< buffers seen while a frame was moving in
  std::vector<FifoEntry> fifo;  ///< six at most; the first is the output
  std::optional<Flight> flight;
  std::vector<std::pair<unsigned, SendRequest>> withdrawn;  ///< lately

  // What has happened on the bus but perhaps not yet in the buffers.
  std::optional<ArrivedFrame> matching;  ///< header known, match not over
  Destination destination;               ///< result of the match
  std::uint64_t left_round = 0;          ///< buffers written since the header: out of the match
  std::uint64_t lock_moved = 0;          ///< ... locked or serviced: free or not
  bool valid = false;                    ///< the frame has ended well
  std::optional<FlightEnd> ended;
  std::optional<unsigned> moved_out;  ///< AEN=1: fixed for the next start
  bool moved_out_abort = false;       ///< ... with an abort request
  std::uint64_t moved_out_since = 0;

 private:
  [[nodiscard]] bool free_to_receive(unsigned n, bool open_as) const;
  [[nodiscard]] bool found_free(unsigned n, bool open_as) const;
  void mailbox_choices(const ArrivedFrame &arrived, const BufferMasks &masks,
                       const BufferConfig &config, std::vector<Destination> &out) const;
  [[nodiscard]] std::vector<Destination> without_fifo(const ArrivedFrame &arrived,
                                                      const BufferMasks &masks,
                                                      const BufferConfig &config) const;
  [[nodiscard]] bool looked_at(unsigned n) const { return ((left_round >> n) & 1) == 0; }
  void move_in(unsigned n, const ArrivedFrame &arrived);
  void push(const ArrivedFrame &arrived, unsigned id_hit);
};

/// C/S, ID and data of a received frame (code 0), with what is promised of them.
[[nodiscard]] KnownWords received_words(const ArrivedFrame &arrived);

}  // namespace vericansim
