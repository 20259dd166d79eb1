// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// what_fails(): see unit_check.hpp.
#include "softerror/clock/unit_check.hpp"

#include <cmath>
#include <utility>

namespace vericansim {
namespace {

constexpr std::uint32_t kFrameId = 0x321, kLaunchId = 0x156;
constexpr Time kCommand = 10 * kMicrosecond;  // a command has shown by then

bool near(std::uint64_t a, std::uint64_t b) {
  return std::abs(static_cast<double>(static_cast<std::int64_t>(a - b))) < kRight;
}

class UnitCheck {
 public:
  explicit UnitCheck(ClockWorld &world) : world_{world} {}

  std::string run() {
    const std::pair<const char *, bool (UnitCheck::*)()> parts[] = {
        {"rate", &UnitCheck::rate},         {"shift", &UnitCheck::shift},
        {"set", &UnitCheck::set},           {"slew", &UnitCheck::slew},
        {"stamp", &UnitCheck::stamp},       {"compare", &UnitCheck::compare},
        {"external", &UnitCheck::external}, {"launch", &UnitCheck::launch},
        {"rest", &UnitCheck::rest}};
    for (const auto &[name, works] : parts)
      if (!(this->*works)()) return name;
    return {};
  }

 private:
  verican_t *dev() { return world_.dev(); }
  std::uint64_t now() {
    std::uint64_t ns = 0;
    (void)verican_clock_get(dev(), &ns);
    return ns;
  }
  /// ns of TIME that pass while the bus runs for `duration`, less those that should, less `more`.
  bool passes(Time duration, std::int64_t more) {
    const Time begin = world_.bus.now();
    const std::uint64_t before = now();
    if (action_) action_();
    world_.run_to(begin + duration);
    const Time end = world_.bus.now();
    const std::uint64_t elapsed = now() - before;
    return near(elapsed, static_cast<std::uint64_t>((end - begin) / kNanosecond + more));
  }

  bool rate() {
    const std::uint64_t increment = dev()->increment;
    action_ = nullptr;
    if (!passes(kMillisecond, 0)) return false;
    (void)verican_clock_rate(dev(), increment / 2);
    world_.run(kCommand);
    const bool half = passes(200 * kMicrosecond, -100'000);
    (void)verican_clock_rate(dev(), increment);
    world_.run(kCommand);
    return half && passes(200 * kMicrosecond, 0);
  }

  bool shift() {
    constexpr std::int64_t kFar = (std::int64_t{1} << 42) + 12'345;
    action_ = [this] { (void)verican_clock_shift(dev(), kFar); };
    if (!passes(kCommand * 2, kFar)) return false;
    action_ = [this] { (void)verican_clock_shift(dev(), -kFar); };
    return passes(kCommand * 2, -kFar);
  }

  bool set() {
    constexpr std::uint64_t kTo = 0x1234'5678'FFFF'FF00;
    const std::uint64_t was = now();
    (void)verican_clock_set(dev(), kTo);
    world_.run(kCommand);
    if (now() - kTo > 2 * kCommand / kNanosecond) return false;
    (void)verican_clock_set(dev(), was);
    world_.run(kCommand);
    return true;
  }

  bool slew() {
    constexpr std::int32_t kBack = -4'000;
    world_.ask(VERICAN_CLOCK_SLEWED);
    action_ = [this] { (void)verican_clock_slew(dev(), kBack); };
    const bool right = passes(5 * kMillisecond, kBack);
    return right && (world_.clock_flags & VERICAN_TSTAT_SLEWD_MASK) != 0 &&
           world_.read(VERICAN_TSLEW_OFFSET) == 0;
  }

  // Of a frame that comes, at its reference edge.
  bool stamp() {
    world_.others.clear();
    world_.source.send({.id = kFrameId, .dlc = 8});
    world_.run(kMillisecond);
    return world_.others.size() == 1 && world_.others[0].id == kFrameId &&
           near(world_.others[0].time_ns, world_.time_at(world_.source.reference()));
  }

  // Five edges, 100 us apart, each told; the pin is low before and behind.
  bool compare() {
    constexpr std::uint32_t kHalf = 100'000;
    constexpr std::uint32_t kParts = VERICAN_TCTRL_CMPEN_MASK | VERICAN_TCTRL_OUTEN_MASK;
    world_.ask(VERICAN_CLOCK_COMPARE);
    const std::uint32_t tctrl = world_.read(VERICAN_TCTRL_OFFSET);
    const std::uint64_t first = now() + 2 * kHalf;
    world_.write(VERICAN_TCMPH_OFFSET, kHalf);
    world_.write(VERICAN_TCTRL_OFFSET, tctrl | kParts);
    world_.write(VERICAN_TCMP_OFFSET, static_cast<std::uint32_t>(first));
    world_.run(kCommand);  // that has set the output to 0
    world_.pulses.clear();
    world_.run(650 * kMicrosecond);
    bool right = world_.pulses.size() == 5 && world_.clock_flags == VERICAN_TSTAT_CMP_MASK;
    for (std::size_t n = 0; n < world_.pulses.size(); ++n)
      right = right && world_.pulses[n].level == (n % 2 == 0) &&
              near(world_.time_at(world_.pulses[n].at), first + n * kHalf);
    world_.write(VERICAN_TCTRL_OFFSET, tctrl & ~kParts);
    world_.run(kCommand);
    return right && !world_.dut().time_out();
  }

  bool external() {
    world_.ask(VERICAN_CLOCK_RISING);
    const Time at = world_.bus.now();
    world_.dut().external(true);
    world_.run(50 * kMicrosecond);
    world_.dut().external(false);
    const bool right = near(world_.event_time, world_.time_at(at));
    world_.run(kCommand);
    return right && world_.clock_flags == VERICAN_TSTAT_EXT_MASK;
  }

  // SOF is due within two bits of the launch time (TM-42).
  bool launch() {
    world_.ask(VERICAN_CLOCK_RELEASED);
    const std::size_t before = world_.sent().size();
    const std::uint64_t at = now() + kLaunchIn;
    const verican_frame_t frame = driver_frame(kLaunchId);
    if (verican_send_at(dev(), &frame, at, nullptr) != VERICAN_OK) return false;
    if (!world_.run_until([&] { return world_.sent().size() > before; }, 2 * kMillisecond))
      return false;
    world_.run(kCommand);
    const auto late = static_cast<std::int64_t>(world_.time_at(world_.sof) - at);
    const std::uint64_t stamp = world_.sent().back().time_ns;
    return late >= 0 && late <= 2 * kBit / kNanosecond + 1'000 &&
           world_.sent().back().outcome == VERICAN_TX_SENT && stamp > at && stamp < now() &&
           world_.clock_flags == VERICAN_TSTAT_TXREL_MASK;
  }

  // Nothing is left behind.
  bool rest() {
    world_.ask(0);
    // The output of the compare unit stays as it is; OUTEN hides it.
    return (world_.read(VERICAN_TSTAT_OFFSET) & ~VERICAN_TSTAT_OUT_MASK) == 0 &&
           world_.read(VERICAN_TCTRL_OFFSET) == VERICAN_TCTRL_RESET && !world_.dut().irq() &&
           !world_.dut().irq_time();
  }

  ClockWorld &world_;
  std::function<void()> action_;
};

}  // namespace

std::string what_fails(ClockWorld &world) { return UnitCheck{world}.run(); }

}  // namespace vericansim
