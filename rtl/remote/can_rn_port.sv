// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_port: access to the block RAM. The node has it while a job needs it, otherwise user logic
// (RN-50, RN-53). The block selects address and write data of a job; bytes of one word that change
// together are written together. It wraps the RAM (can_mb_ram).

module can_rn_port #(
  parameter int MemBytes = 4096,
  parameter InitFile = ""
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,       // present job
  input  logic             odd_i,       // phase 1 or 3
  input  logic             read_i,      // JobMove copies memory to row
  input  logic             same_i,      // JobSame reads the memory in this phase
  input  logic             trigger_i,   // JobMove copies the stage to memory (TRIGGER)
  input  logic [8:0]       cell_i,      // byte of the upper 512 to read or write; 0: none
  input  logic [8:0]       read_cell_i, // the same of JobGuard, which only reads; comes late
  input  logic             we_i,        // node writes
  input  logic             wide_i,      // all bytes of the word are written
  input  logic [11:0]      mem_i,       // address of the mover in the memory
  input  logic             staged_i,    // mem_i lies in the stage
  input  logic [7:0]       wbyte_i,     // byte to write
  input  logic [6:0]       a_i,         // A of the request
  input  logic [1:0]       same_id_i,   // identifier of the answer (RN-16), see can_rn_tx
  input  logic [3:0]       end_i,       // length of the answer
  input  logic [3:0]       code_i,      // result code of the request
  input  logic [7:0]       status_i,    // byte 0 of STATUS
  input  logic [7:0]       tec_i,       // byte 1 of STATUS
  input  logic [7:0]       rec_i,       // byte 2 of STATUS
  output logic [1:0]       lane_o,      // place in the word of the byte that is read
  output logic             re_o,        // RAM is read in this clock
  output logic [9:0]       raddr_o,     // word address of that read
  output logic [31:0]      rdata_o,     // word read, in the clock after
  // User logic
  input  logic             usr_req_i,   // access requested
  input  logic             usr_we_i,    // access writes
  input  logic [3:0]       usr_be_i,    // byte enables
  input  logic [9:0]       usr_addr_i,  // word address
  input  logic [31:0]      usr_wdata_i, // word to write
  output logic             usr_ready_o, // access is carried out in this clock
  output logic             usr_absent_o // read in the clock before hit no memory (RN-53)
);
  localparam int AddrWidth = $clog2(MemBytes / 4);

  logic        absent, user, from_mem, to_mem, usr_write, status, push, count;
  logic [9:0]  address, target;
  logic [3:0]  we, lanes;
  logic [31:0] wdata;
  logic [1:0]  lane;

  assign user        = job_i[5:2] == 4'd0;
  assign usr_ready_o = user;

  // With less than 4,096 bytes, the upper 512 are the last of the RAM. Words between them and the
  // memory would alias others: user logic reads them as 0, and its writes are ignored.
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

  // User logic cannot write 0xE00..0xEFF and 0xFE0..0xFFF; these belong to the node.
  assign usr_write = usr_req_i && usr_we_i && !absent
                     && !((&usr_addr_i[9:7]) && (!usr_addr_i[6] || (&usr_addr_i[5:3])));

  assign from_mem = (job_i == can_rn_pkg::JobMove && read_i) || same_i;
  assign to_mem   = (job_i == can_rn_pkg::JobMove && !read_i) || job_i == can_rn_pkg::JobClear;
  assign target   = {mem_i[11:9] | {3{staged_i && !trigger_i && !job_i[1]}}, mem_i[8:2]};
  assign address  = user ? usr_addr_i : {3'b111, cell_i[8:2]};
  assign lane     = to_mem ? mem_i[1:0] : cell_i[1:0];
  assign lane_o   = from_mem ? mem_i[1:0] : cell_i[1:0] | read_cell_i[1:0];

  // Words of which several bytes change together: {code, REC, TEC, state}, {count, A} of STATUS,
  // {length, A} of a row.
  // The bits decoded here tell these jobs from others that write.
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
