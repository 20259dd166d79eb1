// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// softerror_remote: flips every flip-flop of a remote node under traffic and tells what it took to
// make the node work again (RN-103, docs/soft-errors.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <stdexcept>

#include "softerror/flip_plan.hpp"
#include "softerror/remote/run.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kRounds = 20;  // flips of each flip-flop

struct Sum {
  std::array<unsigned, 5> cures{};
  unsigned flips = 0, babbled = 0, wrong_sent = 0;
  std::vector<std::string> notes;

  void add(const FlopFlip &flip, const RemoteOutcome &outcome) {
    ++flips;
    ++cures.at(static_cast<std::size_t>(outcome.cure));
    babbled += outcome.babbled;
    wrong_sent += outcome.wrong_sent;
    const bool hangs = outcome.cure >= RemoteCure::kReset;
    if (hangs || outcome.babbled)
      notes.push_back(fmt::format("{} at clock {}: {}", FlopRemote::flops().names()[flip.flop],
                                  flip.clock, outcome.babbled ? "babbles" : "hangs"));
  }
  [[nodiscard]] unsigned hangs() const { return cures[3] + cures[4]; }
};

Json result_of(const Sum &sum) {
  const auto none = [](const char *name, unsigned value) {
    return campaign_figure(name, value, "0", value == 0);
  };
  return {{"figures",
           {campaign_figure("flip-flops flipped", FlopRemote::flops().names().size()),
            campaign_figure("flips", sum.flips), none("hangs", sum.hangs()),
            none("babbling", sum.babbled), campaign_figure("works again by itself", sum.cures[0]),
            campaign_figure("works again after RESTART", sum.cures[1]),
            campaign_figure("works again after RESTART and ASSIGN", sum.cures[2]),
            campaign_figure("sent under an identifier of the host", sum.wrong_sent)}},
          {"tables", Json::array()},
          {"notes", sum.notes}};
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Soft errors of a remote node"};
  try {
    FlipPlan plan{FlopRemote::flops(), kRounds, kFlipFrom, kFlipTo};
    plan.add_to(app);
    if (const auto end = read_options(app, argc, argv)) return *end;
    if (run_flip({0, ~0ULL, {}}).cure != RemoteCure::kNone)
      throw std::runtime_error("the node does not work without a flip");
    const auto sum = run_flips<Sum>(plan, run_flip, result_of);
    return sum.hangs() + sum.babbled == 0 ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "softerror_remote: {}\n", error.what());
    return 2;
  }
}
