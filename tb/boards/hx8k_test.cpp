// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// examples/hx8k, whole: the board, by its pins alone, on a bus with two other nodes, and node.c,
// the program of the example, at a pseudo-terminal. CMakeLists.txt says BOARD_MODEL, BOARD_HEADER,
// BIT_CLOCKS (clocks of a bit of the serial port), SILENCE (clocks after which a command is
// dropped) and PINGS.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include BOARD_HEADER
#include "boards/board_bus.hpp"
#include "boards/serial_line.hpp"
#include "boards/serial_program.hpp"
#include "bus/bus.hpp"
#include "node/core_node.hpp"
#include "node/model_context.hpp"
#include "remote/frame_texts.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

enum Light : unsigned { kRunning = 1, kReceived = 2, kSent = 4, kPassive = 8, kBusOff = 16 };

/// The board.
class SerialBoard : public Node {
 public:
  explicit SerialBoard(const ClockConfig &clock) : Node{"board", clock} {
    model_.serial_rx_i = 1;
    model_.can_rx_i = 1;
    model_.clk_i = 0;
    model_.eval();
  }
  ~SerialBoard() override { model_.final(); }
  SerialBoard(const SerialBoard &) = delete;
  SerialBoard &operator=(const SerialBoard &) = delete;

  void clock(Level rx) override {
    model_.can_rx_i = static_cast<std::uint8_t>(rx);
    model_.serial_rx_i = line.clock(model_.serial_tx_o != 0);
    model_.clk_i = 1;
    model_.eval();
    model_.clk_i = 0;
    model_.eval();
    drive(static_cast<Level>(model_.can_tx_o));
  }
  [[nodiscard]] unsigned lights() const { return model_.leds_o; }

  SerialLine line{BIT_CLOCKS};

 private:
  SerialContext context_;
  BOARD_MODEL model_{&context_};
  ModelContext model_context_{context_};
};

/// Pulls the bus down for ten bits, once, some bits after the next start of a frame.
class Disturber : public Node {
 public:
  using Node::Node;
  void disturb() { left_ = kBefore + kLength; }
  void clock(Level rx) override {
    if (left_ != 0 && (left_ < kBefore + kLength || rx == Level::kDominant)) --left_;
    drive(left_ != 0 && left_ <= kLength ? Level::kDominant : Level::kRecessive);
  }

 private:
  static constexpr unsigned kBefore = 12 * 30, kLength = 12 * 10;  // clocks
  unsigned left_ = 0;
};

class Hx8k : public ::testing::Test {
 protected:
  Hx8k() {
    for (Node *node : {static_cast<Node *>(&board_), static_cast<Node *>(&a_),
                       static_cast<Node *>(&b_), static_cast<Node *>(&disturber_)})
      bus_.add(*node);
  }

  /// The other nodes take part.
  void others() {
    a_.start();
    b_.start();
  }
  /// `before`: a command that starts the program.
  void start(const std::vector<std::string> &more = {}, std::vector<std::string> before = {}) {
    std::vector<std::string> command{std::move(before)};
    for (const char *word : {NODE_PROGRAM, "-b", "1000000", "-t", "240000"})
      command.emplace_back(word);
    command.insert(command.end(), more.begin(), more.end());
    program_ = std::make_unique<SerialProgram>(std::move(command));
  }

  /// Ten bits of the bus, and what goes over the terminal meanwhile.
  void step() {
    bus_.run_for(10 * kMicrosecond);
    const std::string said = board_.line.said();
    if (!said.empty()) program_->to_terminal(said);
    board_.line.type(program_->from_terminal());
    for (std::string &text : program_->lines()) {
      if (text.rfind('(', 0) == 0) {
        frames_.push_back(text.substr(text.rfind(' ') + 1));
        seconds_.push_back(std::stod(text.substr(1)));
      } else {
        told_.push_back(text);
      }
    }
    // The program is to say something: let it.
    if (board_.line.resting() && !a_.pending() && !b_.pending()) program_->wait();
  }
  template <typename Done>
  bool run_until(Done done, unsigned milliseconds) {
    for (unsigned i = 0; i < milliseconds * 100; ++i) {
      if (done()) return true;
      const bool ended = program_->exit_code() >= 0;
      step();  // also of one that has ended, to see its last words
      if (ended) return done();
    }
    return done();
  }
  static std::string text_of(const Frame &frame) { return candump_frame(frame); }
  static std::string numbered(const char *head, unsigned n) {
    char text[32];
    (void)std::snprintf(text, sizeof text, "%s%02X#%02X%s", head, n, n, n % 3 == 0 ? "" : "5AA5");
    return text;
  }

  /// A frame of the program's, and the answer of a node of the bus.
  void ping_from_program(unsigned n) {
    program_->line(numbered("1", n));
    ASSERT_TRUE(run_until([&] { return a_.received().size() == 1; }, 2000)) << told();
    EXPECT_EQ(text_of(a_.received()[0]), numbered("1", n));
    a_.received().clear();
    b_.received().clear();
    a_.request(frame_of(numbered("2", n)));
    ASSERT_TRUE(run_until([&] { return !frames_.empty(); }, 2000)) << told();
    EXPECT_EQ(frames_, std::vector<std::string>{numbered("2", n)});
    frames_.clear();
    b_.received().clear();
  }
  /// The other way round; the test is the user at the program.
  void ping_from_bus(unsigned n) {
    b_.request(frame_of(numbered("3", n)));
    ASSERT_TRUE(run_until([&] { return !frames_.empty(); }, 2000)) << told();
    EXPECT_EQ(frames_, std::vector<std::string>{numbered("3", n)});
    frames_.clear();
    a_.received().clear();
    program_->line(numbered("4", n));
    ASSERT_TRUE(run_until([&] { return b_.received().size() == 1; }, 2000)) << told();
    EXPECT_EQ(text_of(b_.received()[0]), numbered("4", n));
    b_.received().clear();
    a_.received().clear();
  }
  [[nodiscard]] std::string told() const { return ::testing::PrintToString(told_); }
  bool lit(unsigned lights) const { return (board_.lights() & lights) == lights; }

  SerialBoard board_{BoardBus::clock()};
  CoreNode a_{"a", {.timing = BoardBus::timing()}, BoardBus::clock()};
  CoreNode b_{"b", {.timing = BoardBus::timing()}, BoardBus::clock()};
  Disturber disturber_{"disturber", BoardBus::clock()};
  Bus bus_;
  std::unique_ptr<SerialProgram> program_;
  std::vector<std::string> frames_, told_;
  std::vector<double> seconds_;  ///< times of all frames that it has printed
};

// Each way PINGS frames and their answers, every tenth with an error on the line in a frame of
// either side: all arrive, once, and are told as they were.
TEST_F(Hx8k, PingsBothWaysWithErrorsOnTheLine) {
  others();
  start();
  EXPECT_FALSE(lit(kRunning));
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  for (unsigned n = 0; n < PINGS; ++n) {
    if (n % 10 == 3) disturber_.disturb();
    ping_from_program(n);
    if (n % 10 == 8) disturber_.disturb();
    ping_from_bus(n);
    if (HasFatalFailure()) return;
  }
  EXPECT_TRUE(lit(kReceived | kSent));
  EXPECT_FALSE(lit(kPassive));
  EXPECT_FALSE(lit(kBusOff));
  EXPECT_NE(a_.events().errors, 0);
  EXPECT_EQ(told_, std::vector<std::string>{});
  program_->end_of_input();
  EXPECT_TRUE(run_until([&] { return program_->exit_code() == 0; }, 1000)) << told();
}

// A command that stops in the middle, and one that is none, are gone after the silence; the program
// finds the board as ever.
TEST_F(Hx8k, CommandsThatAreCutOffAreDropped) {
  others();
  for (const std::string &cut : {std::string{"\x02\x01\x00", 3}, std::string{"\x01\x05\x00\x00", 4},
                                 std::string{"\xFF\x00\x07", 3}}) {
    board_.line.type(cut);
    while (!board_.line.silent()) bus_.run_for(10 * kMicrosecond);
    bus_.run_for((SILENCE + 2000) * kMicrosecond / 12);
  }
  EXPECT_EQ(board_.line.said(), "");
  start({"-l"});
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  ping_from_program(1);
}

// Nobody acknowledges: the board becomes error passive, and says so.
TEST_F(Hx8k, LightsTellTheErrorState) {
  start();
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  program_->line("123#");
  EXPECT_TRUE(run_until([&] { return lit(kPassive); }, 1000)) << told();
  EXPECT_FALSE(lit(kSent));
  EXPECT_TRUE(
      run_until([&] { return !told_.empty() && told_.back() == "node: error passive"; }, 1000))
      << told();
}

// What is no frame ends the program with a sentence.
TEST_F(Hx8k, AWrongLineOfInputIsTold) {
  for (const std::string line : {"12#3", "+12#11", "0x1#11", " 12#11", "123#R9", "123#1"}) {
    told_.clear();
    start();
    program_->line(line);
    EXPECT_TRUE(run_until([&] { return !told_.empty(); }, 5000));
    EXPECT_EQ(told_, std::vector<std::string>{"node: '" + line + "' is no frame; 123#1122 is one"});
    EXPECT_TRUE(run_until([&] { return program_->exit_code() == 1; }, 1000));
  }
}

TEST_F(Hx8k, ALastLineWithoutLineEndIsSent) {
  others();
  start();
  program_->type("123#11\n124#22");
  program_->end_of_input();
  EXPECT_TRUE(run_until([&] { return program_->exit_code() == 0; }, 3000)) << told();
  ASSERT_EQ(a_.received().size(), 2U);
  EXPECT_EQ(text_of(a_.received()[1]), "124#22");
}

// Lines wait while nobody acknowledges; then they leave as they came, whatever their identifiers.
TEST_F(Hx8k, LinesAreSentInTheirOrder) {
  start();
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  const std::vector<std::string> lines{"300#01", "200#02", "100#03", "200#04"};
  for (const std::string &line : lines) program_->line(line);
  ASSERT_TRUE(run_until([&] { return lit(kPassive); }, 1000)) << told();
  (void)run_until([] { return false; }, 10);  // all are in their mailboxes
  others();
  program_->end_of_input();
  EXPECT_TRUE(run_until([&] { return program_->exit_code() == 0; }, 3000)) << told();
  std::vector<std::string> received;
  for (const Frame &frame : a_.received()) received.push_back(text_of(frame));
  EXPECT_EQ(received, lines);
}

// The core's time has 16 bits, 65 ms at this rate, of which half tell how much has passed: the
// program follows it while nothing comes.
TEST_F(Hx8k, TimesGoOnOnASilentBus) {
  others();
  start({"-l"});
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  bus_.run_for(20 * kMicrosecond);  // the board takes part after eleven recessive bits
  ping_from_bus(1);
  const Time first = bus_.now();
  ping_from_bus(2);
  const Time silence = bus_.now() + 50 * kMillisecond;
  (void)run_until([&] { return bus_.now() >= silence; }, 60);
  const double seconds = 1e-12 * static_cast<double>(bus_.now() - first);
  ping_from_bus(3);
  ASSERT_EQ(seconds_.size(), 3U);
  EXPECT_NEAR(seconds_[2] - seconds_[1], seconds, 0.001);
}

// More frames without a pause than 24 mailboxes hold while the program reads the first ones; at the
// real speed of the port it reads none meanwhile.
TEST_F(Hx8k, LostFramesAreTold) {
  others();
  start({"-l"});
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  bus_.run_for(20 * kMicrosecond);  // the board takes part after eleven recessive bits
  for (unsigned n = 0; n < 80; ++n) b_.request(frame_of(numbered("1", n)));
  ASSERT_TRUE(run_until([&] { return !b_.pending() && !told_.empty(); }, 2000));
  (void)run_until([] { return false; }, 20);
  EXPECT_GE(frames_.size(), 2U);
  EXPECT_LT(frames_.size(), 80U);
  EXPECT_EQ(told_[0], "node: frames were lost: the serial port is slower than the bus");
}

// A frame that was received and cannot be shown is not passed over.
TEST_F(Hx8k, OutputThatCannotBeWrittenIsTold) {
  others();
  start({"-l"}, {"/bin/sh", "-c", "exec \"$0\" \"$@\" >/dev/full"});
  ASSERT_TRUE(run_until([&] { return lit(kRunning); }, 5000)) << told();
  bus_.run_for(20 * kMicrosecond);  // the board takes part after eleven recessive bits
  b_.request(frame_of("123#11"));
  const auto last_words = [&] { return program_->exit_code() == 1 && !told_.empty(); };
  EXPECT_TRUE(run_until(last_words, 2000)) << told();
  EXPECT_EQ(told_, std::vector<std::string>{"node: standard output: No space left on device"});
}

}  // namespace
}  // namespace vericansim
