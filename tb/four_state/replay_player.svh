// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// replay_player: plays the rows to the device of replay.sv, replay_remote.sv or replay_follower.sv
// and counts what differs; they give it clk, rows, take_row, check_outputs and power_up.

  task unknown(input [8*100-1:0] name);
    begin
      xs = xs + 1;
      if (xs <= 20) $display("X clock %0d %0s", row, name);
    end
  endtask

  task check(input [8*12-1:0] name, input [48:0] seen, input [48:0] want);
    if (seen !== want) begin
      diffs = diffs + 1;
      if (diffs <= 20) $display("DIFF clock %0d %0s is %0h, recorded %0h", row, name, seen, want);
    end
  endtask

  // +most=NUMBER: a replay ends behind so many findings.
  integer most;
  initial begin
    diffs = 0;
    xs = 0;
    cleared = 0;
    if (!$value$plusargs("rows=%s", path) || !$value$plusargs("count=%d", count)
        || count > MaxRows) begin
      $display("replay: +rows=FILE +count=NUMBER, at most %0d", MaxRows);
      $finish;
    end
    $readmemh(path, rows, 0, count - 1);
    clk = 0;
    row = -1;
    power_up;
    repeat (3) begin
      #5 clk = 1;
      #5 clk = 0;
    end
    if (!$value$plusargs("most=%d", most)) most = 0;
    for (row = 0; row < count && (most == 0 || diffs + xs < most); row = row + 1) begin
      take_row;
      #4 check_outputs;
      #1 clk = 1;
      #5 clk = 0;
    end
    $display("END clocks %0d diffs %0d xs %0d", row, diffs, xs);
    $finish;
  end
