// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clocks from a valid frame to what it shows user logic, at eight clocks a bit: RN-37, RN-45.
#include <algorithm>

#include "remote/port_fixture.hpp"
#include "remote/remote_entries.hpp"

namespace vericansim {
namespace {

constexpr unsigned kInt2 = 3 * FramePort::kBit;  // clocks from the SP of EOF6 to that of INT2

class PortClocks : public PortFixture {
 protected:
  PortClocks() { write(0xF08, 1 << 7); }  // a page that nobody here writes is protected

  // From the SP of EOF6 to the last pulse; 0: none.
  unsigned shown_after(const Frame &frame) {
    port->clocks(300);
    (void)port->take_pulses();
    port->receive_until_valid(frame);
    const std::uint64_t eof6 = port->clocks() - 1;
    port->clocks(FramePort::kBit - 2);
    for (unsigned bits = 0; bits < 9; ++bits) port->bit();
    const bool shown = !port->take_pulses().empty();
    (void)drain();
    return shown ? static_cast<unsigned>(port->pulse_clock() - eof6) : 0;
  }
  unsigned shown_after(const std::string &text) { return shown_after(frame_of(text)); }
  // The same of a frame of `n` bytes that entry 7, the last that is searched, takes.
  unsigned mapped(unsigned n, unsigned address, unsigned flags) {
    write(map_at(7), map_bytes(0x6A0, 0x7FF, address, flags));
    Frame frame = frame_of("6A0#0102030405060708");
    frame.dlc = static_cast<std::uint8_t>(n);
    std::fill(frame.data.begin() + n, frame.data.end(), std::uint8_t{0});
    return shown_after(frame);
  }
};

// RN-45: in the clock after the SP of INT2, however long the work is.
TEST_F(PortClocks, EveryWriteIsShownAfterInt2) {
  for (const char *text : {"190#01", "1A0#0102030405060708", "091#01020304050607",
                           "1F9#0002AABBCCDDEEFF", "1F9#FF0DAA", "001#05", "001#"})
    EXPECT_EQ(shown_after(text), kInt2) << text;
  for (unsigned n = 1; n <= 8; ++n)
    for (const unsigned address : {0x010U, 0x014U, 0x2FFU})
      EXPECT_EQ(mapped(n, address, 0), kInt2) << n << ' ' << address;
}

// RN-37, RN-45: nor is an entry late that acts as a TRIGGER, which has two copies to make.
TEST_F(PortClocks, AMapEntryThatTriggers) {
  for (const bool operates : {true, false}) {
    operate(operates);
    for (unsigned n = 0; n <= 8; ++n)
      for (const unsigned address : {0x010U, 0x014U, 0x2FFU})
        EXPECT_EQ(mapped(n, address, 0x20), n != 0 || operates ? kInt2 : 0)
            << operates << ' ' << n << ' ' << address;
  }
}

// RN-45, RN-46: a stage of 16 bytes takes eight clocks more. Behind a frame that acts as a TRIGGER
// those are too many by the bytes of the frame (docs/remote.md).
TEST_F(PortClocks, AStageOf16Bytes) {
  port = FramePort::create("standard16", 3, 0xCAFE1234, 3);
  port->start();
  (void)drain();
  operate(true);
  write(0xF08, 1 << 7);
  EXPECT_EQ(shown_after("001#05"), kInt2);
  for (unsigned n = 0; n <= 8; ++n) {
    EXPECT_EQ(mapped(n, 0x2FF, 0), n == 0 ? 0 : kInt2) << n;
    EXPECT_EQ(mapped(n, 0x2FF, 0x20), kInt2 + n) << n;
  }
}

}  // namespace
}  // namespace vericansim
