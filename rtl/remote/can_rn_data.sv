// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_data: data path of one byte. The byte read from the RAM is registered before anything is
// decided on it (RN-81): a byte addressed in one clock is in byte_o two clocks later. The byte
// written is that byte plus or minus a small number, a byte of the frame, the result code, or
// during JobClear the initial contents (RN-60).

module can_rn_data #(
  parameter int NameBits = 3,
  parameter int MemBytes = 4096,
  parameter int StageBytes = 8,
  parameter int Features = 1,
  parameter bit Compare = 1'b0
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  can_rn_pkg::job_t    job_i,        // present job
  input  logic                none_i,       // JobTrigger: frame has no count, one is added
  input  logic [1:0]          lane_i,       // place in the word of the byte read in this clock
  input  logic [31:0]         rdata_i,      // word read, one clock after its address
  input  logic [7:0]          frame_i,      // byte of the frame on the bus
  input  logic [8:0]          block_i,      // JobClear: block of eight bytes that is written
  input  logic [3:0]          place_i,      // JobClear: byte in this block, 8: first of the next
  input  logic [NameBits-1:0] node_i,       // node number at reset
  input  logic [31:0]         serial_i,     // serial number
  input  logic                last_i,       // phase 2 or 3
  input  logic                less_i,       // ~add_i is added instead of add_i, in the clock after
  input  logic                more_i,       // 1 more is added, in the clock after
  input  logic [2:0]          add_i,        // added to the byte read, in this clock
  input  logic [3:0]          code_i,       // JobClose: code to store
  output logic [7:0]          next_o,       // byte read, not registered
  output logic [7:0]          byte_o,       // byte read, registered
  output logic                zero_o,       // byte_o is 0
  output logic                one_o,        // byte_o is 1
  output logic                differ_o,     // byte_o differs from the byte read before it
  output logic [8:0]          sum_o,        // byte to write, with carry
  output logic                same_o,       // byte of the frame equals sum_o
  output logic                equal_o,      // byte of the frame equals byte_o
  output logic [7:0]          wbyte_o       // byte to write
);
  logic [7:0] byte_q, lane_byte;
  logic [1:0] lane_q;
  logic       read_q, few, zero, zero_q, one_q;

  always_comb begin
    case (lane_q)
      2'd0:    lane_byte = rdata_i[7:0];
      2'd1:    lane_byte = rdata_i[15:8];
      2'd2:    lane_byte = rdata_i[23:16];
      default: lane_byte = rdata_i[31:24];
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      lane_q <= '0;
      read_q <= 1'b0;
      byte_q <= '0;
      {zero_q, one_q} <= 2'b10;
    end else begin
      lane_q <= lane_i;
      // Only what the node reads: no access of user logic, and no contents before they are cleared.
      read_q <= (|job_i[5:3]) || (job_i[2] && !job_i[1]);
      if (read_q) byte_q <= lane_byte;
      if (read_q) {zero_q, one_q} <= {zero, few && lane_byte[0]};
    end
  end

  assign next_o = lane_byte;
  assign few    = !(|lane_byte[7:1]);
  assign zero   = few && !lane_byte[0];
  assign zero_o = zero_q;
  assign one_o  = one_q;
  assign byte_o = byte_q;

  if (!Compare) begin : gen_alone
    assign differ_o = 1'b0;
  end else begin : gen_compare
    logic differ_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni)     differ_q <= 1'b0;
      else if (read_q) differ_q <= byte_q != lane_byte;
    end
    assign differ_o = differ_q;
  end

  // Initial contents (RN-60) of a byte, given by its block of eight and its place there. As the
  // mover counts, the first byte of a block is place 8 of the block before. All other bytes are 0.
  function automatic logic [7:0] first_byte(input logic [8:0] block, input logic [3:0] place);
    logic top, e00, f00, ident;
    logic [7:0] conf, id;
    top   = &block[8:6];
    e00   = top && block[5:0] == 6'h00;
    f00   = top && block[5:0] == 6'h20;
    ident = top && (&block[5:0]);
    case (place[2:0])
      3'd1: conf = 8'h05;
      3'd4, 3'd5: conf = 8'h0A;
      3'd6: conf = 8'h32;
      3'd7: conf = 8'h08;
      default: conf = 8'h00;
    endcase
    case (place[2:0])
      3'd1: id = 8'(Features);
      3'd2: id = {4'(NameBits), 4'($clog2(MemBytes))};
      3'd3: id = 8'(StageBytes);
      3'd4: id = serial_i[7:0];
      3'd5: id = serial_i[15:8];
      3'd6: id = serial_i[23:16];
      3'd7: id = serial_i[31:24];
      default: id = 8'h00;
    endcase
    first_byte = (conf & {8{f00}}) | (id & {8{ident}});
    if (e00 && place[2:0] == 3'd4) first_byte = first_byte | 8'd40;
    if (top && place[3] && block[5:0] == 6'h1F) first_byte = first_byte | 8'(node_i);
    if (top && place[3] && block[5:0] == 6'h3E) first_byte = first_byte | 8'h01;
  endfunction

  // Registered one clock before the byte is written: no job writes a sum before its third phase. Of
  // a two-byte number, the high byte decrements if the low one was 0.
  logic less_q, more_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {less_q, more_q} <= '0;
    end else begin
      less_q <= job_i == can_rn_pkg::JobLow || job_i == can_rn_pkg::JobHigh
                || job_i == can_rn_pkg::JobTry || job_i == can_rn_pkg::JobAge
                || (Compare && job_i == can_rn_pkg::JobGap)
                || ((job_i == can_rn_pkg::JobFeed || (Compare && job_i == can_rn_pkg::JobDown))
                    && (!last_i || zero_o))
                || less_i;
      more_q <= job_i == can_rn_pkg::JobCount || more_i
                || (job_i == can_rn_pkg::JobTrigger && none_i);
    end
  end

  logic [8:0] sum;
  assign sum     = {1'b0, byte_q} + {1'b0, {8{less_q}} ^ {5'd0, add_i}} + 9'(more_q);
  assign sum_o   = sum;
  assign same_o  = sum[7:0] == frame_i;
  assign equal_o = byte_q == frame_i;
  always_comb begin
    case (job_i)
      can_rn_pkg::JobByte:  wbyte_o = frame_i;
      can_rn_pkg::JobClear: wbyte_o = first_byte(block_i, place_i);
      can_rn_pkg::JobClose: wbyte_o = {3'd0, code_i[3], 1'b0, code_i[2:0]};
      default:              wbyte_o = sum[7:0];
    endcase
  end

endmodule
