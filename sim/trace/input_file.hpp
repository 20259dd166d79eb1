// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Input files: plain, packed with gzip, or standard input.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vericansim {

/// Bytes of a recording, unpacked if it is packed: 1 GiB.
inline constexpr std::size_t kMostRead = std::size_t{1} << 30;
/// Bytes of a file that somebody has written, such as a scenario: 64 MiB.
inline constexpr std::size_t kMostWritten = std::size_t{64} << 20;

/// Reads a whole file as it is; "-" is standard input. Throws InputError if it cannot be opened or
/// has more than `most` bytes (a device may never end), or if reading fails.
[[nodiscard]] std::string read_bytes(const std::string &path, std::size_t most = kMostRead);

/// The same; what begins as gzip does is unpacked, whatever its name, and a byte-order mark (UTF-8)
/// is left out. Throws InputError if it cannot be unpacked, too.
[[nodiscard]] std::string read_text_file(const std::string &path, std::size_t most = kMostRead);

/// Throws InputError naming `path` if `text` is in UTF-16, as redirections of some shells write it.
void refuse_utf16(std::string_view text, const std::string &path);

/// `bytes` without gzip's packing, or as they are. Throws InputError naming `path` if they are
/// damaged or unpack to more than `most` bytes.
[[nodiscard]] std::string unpacked(std::string bytes, const std::string &path,
                                   std::size_t most = kMostRead);

/// `path` without a last ".gz".
[[nodiscard]] std::string_view without_gz(std::string_view path);

}  // namespace vericansim
