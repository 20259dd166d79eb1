// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_regs: registers of the time unit at 0x1100 to 0x117F (TM-03, TM-30 to TM-40), flags and
// external event. A write becomes a command to can_time one clock later. Registers that software
// only has to write cannot be read back (TM-131).

module can_time_regs (
  input  logic        clk_i,
  input  logic        rst_ni,
  // CPU, in the data phase
  input  logic        ask_i,         // in the clock before a read of TIMELO
  input  logic        rd_i,          // read
  input  logic        wr_i,          // write
  input  logic [4:0]  addr_i,        // word address in the page
  input  logic [3:0]  be_i,          // byte enables
  input  logic [31:0] wdata_i,
  output logic [31:0] rdata_o,
  // can_time
  output logic [can_pkg::TimeCmdWidth-1:0] cmd_o, // command pulses, can_pkg::Time*
  output logic [63:0] data_o,        // data of the command
  input  logic [63:0] now_i,         // TIME of the last read of TIMELO
  input  logic [63:0] ext_i,         // TIME of the last external event
  input  logic [31:0] left_i,        // TSLEW: rest of a slew
  output logic [31:0] tctrl_o,       // TCTRL
  output logic [31:0] tcmph_o,       // TCMPH
  output logic [31:0] ttx_o,         // TTX
  input  logic [can_pkg::TimeStatWidth-1:0] stat_i, // levels and pulses, can_pkg::TimeStat*
  // Launch
  output logic [5:0]  mb_o,          // TTXMB.MB: buffer that may be held
  // Pins and interrupt
  input  logic        pin_i,         // external event, asynchronous
  output logic        time_out_o,    // level: compare output, if TCTRL.OUTEN
  output logic        irq_o          // level: interrupt request
);
  // Addresses in the page.
  localparam logic [4:0] Tcap   = 5'(can_regs_pkg::TcapAddr);
  localparam logic [4:0] Tctrl  = 5'(can_regs_pkg::TctrlAddr);
  localparam logic [4:0] Tstat  = 5'(can_regs_pkg::TstatAddr);
  localparam logic [4:0] Timelo = 5'(can_regs_pkg::TimeloAddr);
  localparam logic [4:0] Timehi = 5'(can_regs_pkg::TimehiAddr);
  localparam logic [4:0] Tincn  = 5'(can_regs_pkg::TincnAddr);
  localparam logic [4:0] Tincf  = 5'(can_regs_pkg::TincfAddr);
  localparam logic [4:0] Tshlo  = 5'(can_regs_pkg::TshloAddr);
  localparam logic [4:0] Tshhi  = 5'(can_regs_pkg::TshhiAddr);
  localparam logic [4:0] Tslew  = 5'(can_regs_pkg::TslewAddr);
  localparam logic [4:0] Tcmp   = 5'(can_regs_pkg::TcmpAddr);
  localparam logic [4:0] Tcmph  = 5'(can_regs_pkg::TcmphAddr);
  localparam logic [4:0] Ttx    = 5'(can_regs_pkg::TtxAddr);
  localparam logic [4:0] Ttxmb  = 5'(can_regs_pkg::TtxmbAddr);
  localparam logic [4:0] Textlo = 5'(can_regs_pkg::TextloAddr);
  localparam logic [4:0] Texthi = 5'(can_regs_pkg::TexthiAddr);

  // TCTRL and TSTAT take single bytes, all others whole words only. The first word of a pair waits
  // in first_q until the second is written.
  logic        wr_word, wr_ttxmb;
  logic [31:0] first_q, second_q;
  logic [30:0] tcmph_q;
  logic [5:0]  cmd_q;
  assign wr_word  = wr_i && be_i == '1;
  assign wr_ttxmb = wr_word && addr_i == Ttxmb;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {first_q, second_q, ttx_o} <= '0;
      tcmph_q <= '0;
      mb_o    <= '0;
      cmd_q   <= '0;
    end else begin
      if (wr_word && (addr_i == Timelo || addr_i == Tincn || addr_i == Tshlo)) first_q <= wdata_i;
      if (wr_word) second_q <= wdata_i;
      if (wr_word && addr_i == Tcmph) tcmph_q <= wdata_i[30:0];
      if (wr_word && addr_i == Ttx)   ttx_o   <= wdata_i;
      if (wr_ttxmb) mb_o <= wdata_i[can_regs_pkg::TtxmbMb +: can_regs_pkg::TtxmbMbW];
      cmd_q[can_pkg::TimeSet]   <= wr_word && addr_i == Timehi;
      cmd_q[can_pkg::TimeShift] <= wr_word && addr_i == Tshhi;
      cmd_q[can_pkg::TimeRate]  <= wr_word && addr_i == Tincf;
      cmd_q[can_pkg::TimeSlew]  <= wr_word && addr_i == Tslew;
      cmd_q[can_pkg::TimeArm]   <= wr_word && addr_i == Tcmp;
      cmd_q[can_pkg::TimeHold]  <= wr_ttxmb;
    end
  end
  assign data_o  = {second_q, first_q};
  assign tcmph_o = {1'b0, tcmph_q};

  // TCTRL.
  can_reg #(
    .Reset(can_regs_pkg::TctrlReset), .Any(can_regs_pkg::TctrlAny)
  ) u_tctrl (
    .clk_i, .rst_ni, .clear_i(1'b0), .frz_ack_i(1'b0), .lpm_ack_i(1'b0), .wrn_en_i(1'b0),
    .we_i(wr_i && addr_i == Tctrl), .be_i, .wdata_i, .value_o(tctrl_o));

  // External event: an edge is seen in the clock in which the second flip-flop has changed.
  (* ASYNC_REG = "TRUE" *)
  (* altera_attribute = "-name SYNCHRONIZER_IDENTIFICATION FORCED_IF_ASYNCHRONOUS" *)
  (* syn_preserve = 1, syn_replicate = 0 *)
  logic meta_q, settled_q;
  logic       last_q, event_now, take;
  logic [5:0] flags_q, set, clear;   // TSTAT
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {last_q, settled_q, meta_q} <= '0;
    else         {last_q, settled_q, meta_q} <= {settled_q, meta_q, pin_i};
  end
  assign event_now = (settled_q && !last_q && tctrl_o[can_regs_pkg::TctrlExtr])
                  || (!settled_q && last_q && tctrl_o[can_regs_pkg::TctrlExtf]);
  assign take      = event_now && !flags_q[can_regs_pkg::TstatExt];

  // Flags. If a pulse and a clearing write come in the same clock, the flag is set.
  always_comb begin
    set = '0;
    set[can_regs_pkg::TstatExt]    = take;
    set[can_regs_pkg::TstatExtovr] = event_now && !take;
    set[can_regs_pkg::TstatCmp]    = stat_i[can_pkg::TimeStatMatch];
    set[can_regs_pkg::TstatSlewd]  = stat_i[can_pkg::TimeStatSlewed];
    set[can_regs_pkg::TstatTxrel]  = stat_i[can_pkg::TimeStatLaunch];
    set[can_regs_pkg::TstatSync]   = stat_i[can_pkg::TimeStatSync];
  end
  assign clear = wdata_i[5:0] & {6{wr_i && addr_i == Tstat && be_i[0]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) flags_q <= '0;
    else         flags_q <= (flags_q & ~clear) | set;
  end

  always_comb begin
    cmd_o = '0;
    cmd_o[can_pkg::TimeHold:0]  = cmd_q;
    cmd_o[can_pkg::TimeHold]    = cmd_q[can_pkg::TimeHold] && second_q[can_regs_pkg::TtxmbHold];
    cmd_o[can_pkg::TimeRelease] = cmd_q[can_pkg::TimeHold] && !second_q[can_regs_pkg::TtxmbHold];
    cmd_o[can_pkg::TimeExt]     = take;
    cmd_o[can_pkg::TimeRead]    = ask_i;
  end

  // What has been written but is still on its way to can_time reads as written. SLEWING comes there
  // two clocks behind its command, as it falls with the pulse that sets SLEWD.
  logic held, slewing, armed, out, slew_q;
  assign held    = (stat_i[can_pkg::TimeStatHeld] && !cmd_o[can_pkg::TimeRelease])
                || cmd_o[can_pkg::TimeHold];
  assign slewing = stat_i[can_pkg::TimeStatSlewing] || cmd_q[can_pkg::TimeSlew] || slew_q;
  assign armed   = (stat_i[can_pkg::TimeStatArmed] || cmd_q[can_pkg::TimeArm])
                && tctrl_o[can_regs_pkg::TctrlCmpen];
  assign out     = stat_i[can_pkg::TimeStatOut]
                && !(cmd_q[can_pkg::TimeArm] && tctrl_o[can_regs_pkg::TctrlCmpen]);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) slew_q <= 1'b0;
    else         slew_q <= cmd_q[can_pkg::TimeSlew];
  end

  assign time_out_o = stat_i[can_pkg::TimeStatOut] && tctrl_o[can_regs_pkg::TctrlOuten];
  assign irq_o = (flags_q[can_regs_pkg::TstatExt]   && tctrl_o[can_regs_pkg::TctrlExtie])
              || (flags_q[can_regs_pkg::TstatCmp]   && tctrl_o[can_regs_pkg::TctrlCmpie])
              || (flags_q[can_regs_pkg::TstatSlewd] && tctrl_o[can_regs_pkg::TctrlSlewie])
              || (flags_q[can_regs_pkg::TstatTxrel] && tctrl_o[can_regs_pkg::TctrlTxie])
              || (flags_q[can_regs_pkg::TstatSync]  && tctrl_o[can_regs_pkg::TctrlSyncie]);

  always_comb begin
    rdata_o = '0;
    if (rd_i) begin
      case (addr_i)
        Tcap:  rdata_o = can_regs_pkg::TcapReset;
        Tctrl: rdata_o = tctrl_o;
        Tstat: begin
          rdata_o[5:0] = flags_q;
          rdata_o[can_regs_pkg::TstatSlewing] = slewing;
          rdata_o[can_regs_pkg::TstatHeld]    = held;
          rdata_o[can_regs_pkg::TstatOut]     = out;
          rdata_o[can_regs_pkg::TstatCmpon]   = armed;
        end
        Timelo: rdata_o = now_i[31:0];
        Timehi: rdata_o = now_i[63:32];
        Tslew:  rdata_o = left_i;
        Textlo: rdata_o = ext_i[31:0];
        Texthi: rdata_o = ext_i[63:32];
        Ttxmb: begin
          rdata_o[can_regs_pkg::TtxmbHold] = held;
          rdata_o[can_regs_pkg::TtxmbMb +: can_regs_pkg::TtxmbMbW] = mb_o;
        end
        default: ;
      endcase
    end
  end
endmodule
