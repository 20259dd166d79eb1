// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_port: who has the block RAM: the node while it works, else user logic (RN-50, RN-53); and
// what is written. Bytes of one word that change together are written together.

module can_rn_port #(
  parameter int MemBytes = 4096,
  parameter InitFile = ""
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,
  input  logic             odd_i,       // phase 1 or 3
  input  logic             read_i,      // JobMove: memory to row
  input  logic             same_i,      // JobSame: memory
  input  logic             trigger_i,
  input  logic [8:0]       cell_i,      // byte of the upper 512 that is read or written
  input  logic [8:0]       read_cell_i, // or this, of a job that only reads, and that comes late
  input  logic             we_i,
  input  logic             wide_i,      // all bytes of the word
  input  logic [11:0]      mem_i,
  input  logic             staged_i,
  input  logic [7:0]       wbyte_i,
  input  logic [6:0]       a_i,
  input  logic [1:0]       same_id_i,   // identifier of the answer, see can_rn_tx
  input  logic [3:0]       end_i,
  input  logic [3:0]       code_i,
  input  logic [7:0]       status_i,
  input  logic [7:0]       tec_i,
  input  logic [7:0]       rec_i,
  output logic [1:0]       lane_o,      // place of the byte that is read
  output logic             re_o,        // an access reads
  output logic [9:0]       raddr_o,     // this word
  output logic [31:0]      rdata_o,     // in the clock after
  // User logic
  input  logic             usr_req_i,
  input  logic             usr_we_i,
  input  logic [3:0]       usr_be_i,
  input  logic [9:0]       usr_addr_i,
  input  logic [31:0]      usr_wdata_i,
  output logic             usr_ready_o,
  output logic             usr_absent_o // where it read in the clock before is no memory (RN-53)
);
  localparam int AddrWidth = $clog2(MemBytes / 4);

  logic        absent, user, from_mem, to_mem, usr_write, status, push, count;
  logic [9:0]  address, target;
  logic [3:0]  we, lanes;
  logic [31:0] wdata;
  logic [1:0]  lane;

  assign user        = job_i[5:2] == 4'd0;
  assign usr_ready_o = user;

  // A smaller RAM has the upper 512 bytes at its end; words between would be others once more.
  if (MemBytes == 4096) begin : gen_whole
    assign absent       = 1'b0;
    assign usr_absent_o = 1'b0;
    logic unused;
    assign unused = &{1'b0, rst_ni};
  end else begin : gen_part
    assign absent = usr_addr_i[9:7] >= 3'(MemBytes / 512 - 1) && !(&usr_addr_i[9:7]);
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) usr_absent_o <= 1'b0;
      else         usr_absent_o <= absent;
    end
  end

  // E00..EFF and FE0..FFF belong to the node.
  assign usr_write = usr_req_i && usr_we_i && !absent
                     && !((&usr_addr_i[9:7]) && (!usr_addr_i[6] || (&usr_addr_i[5:3])));

  assign from_mem = (job_i == can_rn_pkg::JobMove && read_i) || same_i;
  assign to_mem   = (job_i == can_rn_pkg::JobMove && !read_i) || job_i == can_rn_pkg::JobClear;
  assign target   = {mem_i[11:9] | {3{staged_i && !trigger_i && !job_i[1]}}, mem_i[8:2]};
  assign address  = user ? usr_addr_i : {3'b111, cell_i[8:2]};
  assign lane     = to_mem ? mem_i[1:0] : cell_i[1:0];
  assign lane_o   = from_mem ? mem_i[1:0] : cell_i[1:0] | read_cell_i[1:0];

  // Words: state, TEC, REC, code; A, counts; A, length.
  // The bits that tell them from other jobs that write.
  assign push   = !job_i[4] && job_i[3] && !job_i[2] && job_i[1];
  assign count  = job_i == can_rn_pkg::JobCount;
  assign status = (!job_i[4] && job_i[0] && (job_i[3] ? !job_i[5] : job_i[1]))   // Fresh, Load
                  || (count && odd_i);
  always_comb begin
    for (int b = 0; b < 4; b++) lanes[b] = lane == 2'(b);
    lanes = lanes | {status && count, status, status || push, push || count} | {4{wide_i}};
    we = user ? usr_be_i & {4{usr_write}} : lanes & {4{we_i}};
  end
  always_comb begin
    wdata = {4{wbyte_i}};
    if (push || count)  wdata[7:0]   = {1'b0, a_i};
    if (push)           wdata[15:8]  = {2'd0, same_id_i, end_i};
    if (status)         wdata        = {3'd0, code_i[3], 1'b0, code_i[2:0], rec_i, tec_i, status_i};
    if (user)           wdata        = usr_wdata_i;
  end

  assign re_o    = !user || usr_req_i;
  assign raddr_o = from_mem ? mem_i[11:2] : address | {3'd0, read_cell_i[8:2]};
  can_mb_ram #(.Depth(MemBytes / 4), .InitFile(InitFile)) u_ram (
    .clk_i,
    .re_i(re_o),
    .raddr_i(AddrWidth'(raddr_o)),
    .rdata_o,
    .we_i(we),
    .waddr_i(AddrWidth'(to_mem ? target : address)),
    .wdata_i(wdata)
  );

endmodule
