// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// run_flip(): see run.hpp.
#include "softerror/remote/run.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "boards/board_bus.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

// A node sends at most six dominant bits in a row, and an error in its flag makes it begin again:
// twice that is more than any rule allows a node that is alone in it.
constexpr unsigned kLongestRun = 24 * 12;
constexpr unsigned kBackOff = 15'000;  // bits: BOFF and the recovery itself

class World {
 public:
  explicit World(const FlopFlip &flip) : device_{BoardBus::clock(), flip}, bus_{device_} {}

  RemoteOutcome run() {
    traffic();
    RemoteOutcome outcome{.cure = cure()};
    outcome.babbled = device_.longest_run() > kLongestRun;
    outcome.wrong_sent = wrong_;
    return outcome;
  }

 private:
  std::vector<std::string> send(const std::string &text, bool from_other = false) {
    Frame frame;
    if (!parse_candump_frame(text, frame, {text, 0})) throw std::logic_error("no frame: " + text);
    std::vector<std::string> said = bus_.send(frame, from_other);
    for (const std::string &one : said)
      if (one.size() < 3 || one[0] < '4' || one[0] > '7') wrong_ = true;
    return said;
  }
  // Everything that a node does: statements of a producer, staged bytes, reads of all kinds,
  // blocks.
  void traffic() {
    for (const char *text :
         {"1FC#013412FECA", "1F9#400F4094", "1F9#420F0100", "000#01", "090#1027204E30754099",
          "001#01", "190#R4", "0C0#R1", "1F8#100006", "1A5#0102030405060708", "1FE#R8",
          "002#0000000000000000", "1FA#015A00020A00", "1FA#025B00030A00", "1FB#0001020304050607",
          "1FB#01080A0B"})
      (void)send(text);
    (void)send("7A0#0102", true);
    (void)send("001#02");
  }
  bool works() {
    (void)send("1A5#3C");
    return has(send("1A5#R1"), "5A5#3C");
  }
  static bool has(const std::vector<std::string> &said, const std::string &wanted) {
    for (const std::string &one : said)
      if (one == wanted) return true;
    return false;
  }
  RemoteCure cure() {
    if (works()) return RemoteCure::kNone;
    bus_.run_bits(kBackOff);  // a node that is off the bus comes back by itself
    if (works()) return RemoteCure::kNone;
    (void)send("000#81");
    if (works()) return RemoteCure::kRestart;
    (void)send("002#0000000000000000");
    (void)send("003#03");
    if (works()) return RemoteCure::kAssign;
    device_.reset();
    bus_.run_bits(kBackOff);
    return works() ? RemoteCure::kReset : RemoteCure::kNever;
  }

  FlopRemote device_;
  BoardBus bus_;
  bool wrong_ = false;
};

}  // namespace

RemoteOutcome run_flip(const FlopFlip &flip) { return World{flip}.run(); }

}  // namespace vericansim
