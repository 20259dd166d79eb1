// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModel: block transfers (section 5).
#include <algorithm>

#include "model/remote_model.hpp"

namespace vericansim {

void RemoteModel::block(const Request &request) {
  using Kind = RemoteTransfer::Kind;
  const auto &data = request.frame.data;
  const unsigned op = data[0];
  const unsigned count = data[4] | data[5] << 8;
  if (request.frame.dlc < 6 || request.frame.dlc > 7 || op > 2 || (op != 0 && count == 0))
    return refuse(request, RemoteCode::kValue);
  if (op == 0) {
    accept(request);
    if (transfer_.open()) close_block(RemoteCode::kAborted);
    return;
  }
  if (transfer_.open() || transfer_.answer || outbox_.full())
    return refuse(request, RemoteCode::kBusy);
  transfer_ = {};
  transfer_.kind = static_cast<Kind>(op);
  transfer_.tag = data[1];
  transfer_.address = data[2] | data[3] << 8;
  transfer_.left = count;
  transfer_.gap = request.frame.dlc == 7 ? data[6] : 0;
  fed();
  if (transfer_.kind == Kind::kRead) return status_.accept(request.a);
  status_.accept(request.a, RemoteCode::kOpen);
  close_block(RemoteCode::kOpen);
}

// Answers with op, tag, code, 0, bytes done; all codes but "open" end the transfer.
void RemoteModel::close_block(RemoteCode code) {
  Frame frame;
  frame.id = config_.id(number_, RemotePort::kBlock);
  frame.dlc = 6;
  frame.data = {
      static_cast<std::uint8_t>(transfer_.kind), transfer_.tag,
      static_cast<std::uint8_t>(code),           0,
      static_cast<std::uint8_t>(transfer_.done), static_cast<std::uint8_t>(transfer_.done >> 8)};
  transfer_.answer = frame;
  if (code != RemoteCode::kOpen) transfer_.kind = RemoteTransfer::Kind::kNone;
}

// What a frame of an open block write is, but for its seq.
RemoteCode RemoteModel::check_block_data(const Frame &frame) const {
  if (frame.dlc < 2 || frame.dlc > 8 || frame.dlc - 1U > transfer_.left) return RemoteCode::kValue;
  if (frame.data[0] != transfer_.seq) return RemoteCode::kSequence;
  return memory_.check_write(transfer_.address, frame.dlc - 1U, status_.unlocked);
}

void RemoteModel::block_data(const Request &request) {
  const Frame &frame = request.frame;
  if (transfer_.kind != RemoteTransfer::Kind::kWrite) {
    const bool length = frame.dlc >= 2 && frame.dlc <= 8;
    return refuse(request, length ? RemoteCode::kSequence : RemoteCode::kValue);
  }
  // RN-41: the last frame once more, from a sender that did not see its end (VA-03).
  const auto last = static_cast<std::uint8_t>(transfer_.seq - 1);
  if (transfer_.done != 0 && frame.dlc >= 2 && frame.dlc <= 8 && frame.data[0] == last) return;
  const RemoteCode code = check_block_data(frame);
  if (code != RemoteCode::kAccepted) {
    status_.refuse(request.a, code);  // the answer of BLOCK tells, no STATUS
    return close_block(code);
  }
  const unsigned n = frame.dlc - 1U;
  memory_.bus_write(transfer_.address, {frame.data.data() + 1, n});
  done_.push_back({false, transfer_.address, n});
  fed();
  status_.accept(request.a);
  transfer_.address += n;
  transfer_.done += n;
  transfer_.left -= n;
  ++transfer_.seq;
  transfer_.idle = 0;
  if (transfer_.left == 0) close_block(RemoteCode::kAccepted);
  show();
}

// RN-40
std::optional<Frame> RemoteModel::next_block_frame() {
  if (transfer_.kind != RemoteTransfer::Kind::kRead || transfer_.wait != 0) return std::nullopt;
  const unsigned n = std::min(transfer_.left, 7U);
  const RemoteCode code = memory_.check_read(transfer_.address, n);
  if (code != RemoteCode::kAccepted) {
    close_block(code);
    return std::nullopt;
  }
  Frame frame;
  frame.id = config_.id(number_, RemotePort::kData);
  frame.dlc = static_cast<std::uint8_t>(n + 1);
  frame.data[0] = transfer_.seq++;
  for (unsigned i = 0; i < n; ++i) frame.data[1 + i] = memory_[transfer_.address + i];
  transfer_.address += n;
  transfer_.done += n;
  transfer_.left -= n;
  transfer_.wait = transfer_.gap;
  if (transfer_.left == 0) close_block(RemoteCode::kAccepted);
  return frame;
}

void RemoteModel::tick_block() {
  if (transfer_.wait != 0) --transfer_.wait;
  if (transfer_.kind != RemoteTransfer::Kind::kWrite) return;
  const unsigned limit = 10U * memory_[remote_map::kBlockTimeout];
  if (++transfer_.idle < limit || limit == 0) return;
  status_.count(RemoteCounter::kSequence);
  close_block(RemoteCode::kTimeout);
}

}  // namespace vericansim
