// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveforms and captures on a disk that is full: told in time, and nothing is left there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "harness/small_disk.hpp"
#include "trace/output_error.hpp"
#include "trace/pcap_file.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {
namespace {

constexpr unsigned kSize = 64;  // kilobytes

/// More changes than the disk holds, and that no compression makes small.
void write_wave(WaveSink &sink) {
  std::mt19937_64 random{1};
  const auto noise = sink.add_wire("m", "noise", 64);
  const auto text = sink.add_text("m", "text");
  sink.start();
  for (Time time = 0; time < 20'000; ++time) {
    sink.set(time * kNanosecond, noise, random());
    sink.set(time * kNanosecond, text, std::string_view{"SOF"});
  }
  sink.finish(20'000 * kNanosecond);
}

using Open = std::function<std::unique_ptr<WaveSink>(const std::string &)>;
const Open kKinds[] = {[](const std::string &path) { return open_vcd(path); }, open_fst};

class FullDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!disk.mounted()) GTEST_SKIP() << disk.why();
  }
  void expect_full(const std::function<void()> &write, const std::string &path) {
    try {
      write();
      ADD_FAILURE() << path << ": nobody noticed";
    } catch (const OutputError &error) {
      EXPECT_EQ(error.what(), path + ": cannot be written to its end: No space left on device");
      EXPECT_EQ(error.code(), ENOSPC);
    }
  }

  test::SmallDisk disk{::testing::TempDir() + "full-disk", kSize};
};

TEST_F(FullDisk, Waveforms) {
  for (const Open &open : kKinds) {
    const std::string path = disk.file("wave");
    expect_full([&] { write_wave(*open(path)); }, path);
    EXPECT_EQ(disk.files(), 0U);
  }
}

// Full from the first byte on: what the FST writer maps must not be on that disk.
TEST_F(FullDisk, WaveformsWithoutASingleFreeByte) {
  const std::string path = disk.file("wave");
  std::ofstream{disk.file("filler")} << std::string(kSize << 10, 'x');
  for (const Open &open : kKinds) {
    expect_full([&] { write_wave(*open(path)); }, path);
    EXPECT_EQ(disk.files(), 1U);
  }
}

// The same waves have room enough elsewhere.
TEST_F(FullDisk, NothingIsWrongWhereThereIsRoom) {
  for (const Open &open : kKinds) {
    const std::string path = ::testing::TempDir() + "room.wave";
    EXPECT_NO_THROW(write_wave(*open(path)));
    EXPECT_GT(std::filesystem::file_size(path), kSize << 10);
    std::filesystem::remove(path);
  }
}

TEST_F(FullDisk, Devices) {
  for (const Open &open : kKinds) expect_full([&] { write_wave(*open("/dev/full")); }, "/dev/full");
  const auto capture = [] {
    PcapWriter writer{"/dev/full"};
    writer.write({0, "", {0x123, false, false, 0, {}}});
    writer.commit();
  };
  expect_full(capture, "/dev/full");
}

TEST_F(FullDisk, Captures) {
  const std::string path = disk.file("a.pcap");
  const auto write = [&](int frames) {
    PcapWriter writer{path};
    for (int i = 0; i < frames; ++i)
      writer.write({i * kMillisecond, "", {0x123, false, false, 8, {}}});
    writer.commit();
  };
  expect_full([&] { write(10'000); }, path);
  EXPECT_EQ(disk.files(), 0U);
  EXPECT_NO_THROW(write(1'000));  // 24 + 1,000 x 32 bytes
  EXPECT_EQ(std::filesystem::file_size(path), 32'024U);
  std::ofstream{disk.file("filler")} << std::string(kSize << 10, 'x');
  expect_full([&] { write(1); }, path);  // noticed by commit() alone
  EXPECT_EQ(std::filesystem::file_size(path), 32'024U);
}

TEST(Waves, AreThereOnlyAfterFinish) {
  for (const Open &open : kKinds) {
    const std::string path = ::testing::TempDir() + "unfinished.wave";
    std::filesystem::remove(path);
    {
      const auto sink = open(path);
      const auto wire = sink->add_wire("m", "w", 1);
      sink->start();
      sink->set(0, wire, 1);
      EXPECT_FALSE(std::filesystem::exists(path));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

}  // namespace
}  // namespace vericansim
