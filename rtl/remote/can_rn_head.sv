// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_head: decodes the frame on the bus. From its header follows whether the frame concerns
// this node (RN-01 to RN-03, RN-34); from its bytes, as they pass, everything about the request
// except its address: operation, illegal values, comparison with serial number and node number.
// Producers and block transfers set up A in the same registers, so that a frame of theirs is made
// like an answer.

module can_rn_head #(
  parameter int NameBits = 3,
  parameter int NumProd = 0,
  parameter int NumMap = 0,
  parameter bit Counters = 1'b0,
  parameter bit Block = 1'b0,
  /// Derived, do not override.
  localparam int AddrBits = 10 - NameBits
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  // Engine
  input  logic                hdr_i,          // pulse: header complete
  input  logic                transmitter_i,  // node sends the frame
  input  logic                ide_i,          // frame is extended
  input  logic                rtr_i,          // frame is a remote frame
  input  logic [10:0]         id_i,           // identifier, stable for 3 bits
  input  logic                byte_we_i,      // pulse: byte_i is new
  input  logic [7:0]          byte_i,         // received byte, stable for a bit
  input  logic                valid_i,        // pulse: frame is valid
  input  logic                gap_i,          // no frame on the bus: the last one is over
  // Node
  input  logic [NameBits-1:0] number_i,       // node number
  input  logic                numbered_i,     // number_i is a number (2 or above)
  input  logic [31:0]         serial_i,       // serial number
  // Sequencer
  input  can_rn_pkg::job_t    job_i,          // present job
  input  logic [1:0]          phase_i,        // phase of the job
  input  logic                take_i,         // pulse: waiting header is taken over
  input  logic [3:0]          row_i,          // index of the byte
  input  logic [7:0]          read_i,         // byte read from the RAM
  output logic                hdr_o,          // a received header waits
  output logic                ours_o,         // waiting header: the frame concerns this node
  output logic                search_o,       // waiting header: a map entry may take the frame
  output logic [10:0]         id_o,           // identifier of the frame that was taken over
  input  logic                lost_i,         // JobFind has ended without an entry
  input  logic                hit_i,          // JobFind has found an entry
  input  logic [6:0]          mask_i,         // bits 6:0 of the mask of that entry
  input  logic                aim_i,          // JobAim: aim_at_i is valid
  input  logic [7:0]          aim_at_i,       // map entry: address bits 15:12, length
  input  logic                mapped_i,       // frame is taken by a map entry
  // Block transfers
  input  logic                load_i,         // JobFetch: load_at_i is valid
  input  logic [3:0]          load_at_i,      // block transfer: address bits 15:12
  input  logic                answer_i,       // JobFetch: answer of BLOCK, from phase 1 on
  input  logic [3:0]          length_i,       // length of the frame that is made
  output logic                byte_o,         // a received data byte waits
  output logic                live_o,         // a frame for this node is under way
  output logic                valid_o,        // that frame is valid; waits for the sequencer
  output logic                sys_o,          // frame is a system function (name 0)
  output logic                all_o,          // frame is for all nodes (name 1)
  output logic                dup_o,          // frame is a statement under the own number (RN-11)
  output logic [AddrBits-1:0] a_o,            // A
  output logic                port_o,         // A is one of the last eight: a port
  output logic                key_o,          // byte is compared in JobByte (four phases)
  output logic                count_o,        // byte is the count of a TRIGGER
  output logic [4:0]          op_o,           // operation, number, READ count or length
  output logic                value_bad_o,    // a byte has an illegal value
  output logic                high_bad_o,     // address beyond 12 bits
  output logic                mismatch_o      // serial or number differs; BLOCK: count not 0
);
  logic                hdr_q, byte_q, live_q, valid_q;
  logic [1:0]          class_q, class_d;
  logic [AddrBits-1:0] a_q;
  logic                port_q;   // A is a port; a decoder behind a_q would be late for the mover
  logic                bad_q, high_q, mismatch_q;
  logic [4:0]          op_q;

  // Bit 1: request to name 0 or 1. Bit 0: bit 0 of that name; else statement under the own number.
  localparam logic [1:0] ClassOwn = 2'd0;
  localparam logic [1:0] ClassDup = 2'd1;
  localparam logic [1:0] ClassSys = 2'd2;
  localparam logic [1:0] ClassAll = 2'd3;

  // Header
  logic [NameBits-1:0] name;
  logic                low, own;
  assign name    = id_i[9 -: NameBits];
  assign low     = !(|name[NameBits-1:1]);
  assign own     = numbered_i && name == number_i;
  assign ours_o  = own && !(id_i[10] && rtr_i) || (low && !id_i[10]);
  assign search_o = NumMap != 0 && !rtr_i && (id_i[10] || !(low || own));
  if (NumMap == 0) begin : gen_no_map
    logic unused;
    assign unused = &{1'b0, mask_i, aim_at_i};
    assign id_o   = '0;
  end else begin : gen_map
    logic [NameBits:0] who_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni)     who_q <= '0;
      else if (take_i) who_q <= id_i[10 -: NameBits+1];
      // Identifier bits 6:0 that the mask does not compare are added to the address (RN-65). With
      // NameBits 5, bits 6:5 are part of the name.
      else if (NameBits == 5 && hit_i) who_q[1:0] <= who_q[1:0] & ~mask_i[6:5];
    end
    assign id_o = {who_q, a_q};
  end

  assign class_d = {low && !id_i[10],
                    low ? name[0] && !search_o : id_i[10] && (own || NumMap == 0)};

  assign hdr_o  = hdr_q;
  assign byte_o = byte_q || (byte_we_i && live_q);
  assign live_o = live_q;
  // can_rn_step may be counting a timer: what begins at a sample point may not be over at the next
  // one, if resynchronisation has shortened the bit.
  assign valid_o = live_q && (valid_i || valid_q);
  assign sys_o  = class_q == ClassSys;
  assign all_o  = class_q == ClassAll;
  assign dup_o  = class_q == ClassDup;
  assign a_o    = a_q;
  assign port_o = port_q;

  // Bytes
  logic state, select, setup, get, top, first, second, third, key_byte;
  assign state  = sys_o && a_q[1:0] == 2'd0 && !a_q[2];
  assign select = sys_o && !a_q[0];
  assign setup  = port_o && a_q[2];
  assign get    = port_o && !(|a_q[2:0]);
  assign top    = |byte_i[6:3];
  assign first  = row_i == 4'd0;
  assign second = row_i == 4'd1;
  assign third  = row_i == 4'd2;

  // The first byte of DATA is compared with the expected sequence number.
  logic block, data;
  assign block = Block && port_o && a_q[2:0] == 3'd2;
  assign data  = Block && port_o && a_q[2:0] == 3'd3;

  // Legal: STATE 01, 02, 81; SETUP 1 to 4; READ 1 to 6 bytes; BLOCK op 0 to 2.
  logic state_bad, setup_bad, get_bad, bad, other;
  assign state_bad = byte_i[2] || !(byte_i[1] ^ byte_i[0]) || (byte_i[7] && byte_i[1]);
  assign setup_bad = byte_i[7] || (byte_i[2] ? |byte_i[1:0] : !(|byte_i[1:0]));
  assign get_bad   = byte_i[7] || (&byte_i[2:0]) || !(|byte_i[2:0]);
  assign bad       = (first && ((state && (top || state_bad)) || (setup && (top || setup_bad))))
                     || (third && get && (top || get_bad))
                     || (first && block && (top || byte_i[7] || byte_i[2] || (&byte_i[1:0])));
  assign other     = second && (|byte_i) && !(numbered_i && byte_i == 8'(number_i));

  // Compared bytes: each mask of SELECT, the key of UNLOCK, with counters the count of TRIGGER.
  assign count_o = Counters && sys_o && a_q[1:0] == 2'd1;
  logic [1:0] index;
  logic [7:0] differ;
  assign key_o  = select ? row_i[0] : (setup && !first) || (first && (count_o || data));
  assign index  = select ? row_i[2:1] : row_i[1:0] - 2'd1;
  assign differ = (read_i ^ serial_i[8*index +: 8]) & (byte_i | {8{setup}});

  assign op_o        = op_q;
  assign value_bad_o = bad_q;
  assign high_bad_o  = high_q;
  assign mismatch_o  = mismatch_q;
  assign key_byte    = job_i == can_rn_pkg::JobByte;

  logic idle;
  assign idle = job_i == can_rn_pkg::JobIdle;

  // JobEntry: A is read first, then mode and length.
  logic entry;
  assign entry = NumProd != 0 && job_i == can_rn_pkg::JobEntry;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {hdr_q, byte_q, live_q, valid_q} <= '0;
    end else begin
      hdr_q   <= (hdr_i && !transmitter_i && !ide_i) || (hdr_q && !take_i && !gap_i);
      byte_q  <= byte_o && !idle;
      valid_q <= (valid_i || valid_q) && !idle;
      live_q  <= (take_i ? ours_o || search_o : live_q && !(idle && (valid_i || valid_q)))
                 && !gap_i && !(lost_i && !dup_o);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      class_q <= ClassOwn;
      a_q     <= '0;
      port_q  <= 1'b0;
    end else if (entry && !phase_i[0]) begin
      // A beyond window and ports: class Sys, in which the remote frame of a producer is refused.
      class_q <= {|read_i[7:AddrBits], 1'b0};
      a_q     <= read_i[AddrBits-1:0];
      port_q  <= (&read_i[AddrBits-1:3]) && !(|read_i[7:AddrBits]);
    end else if (Block && job_i == can_rn_pkg::JobFetch && !live_q) begin
      class_q <= ClassOwn;
      a_q     <= {{AddrBits-3{1'b1}}, 2'b01, !answer_i};
      port_q  <= 1'b1;
    end else if (take_i) begin
      class_q <= class_d;
      a_q     <= id_i[AddrBits-1:0];
      port_q  <= (&id_i[AddrBits-1:3]) && class_d != ClassSys;
    end else if (hit_i) begin
      a_q    <= a_q & ~mask_i[AddrBits-1:0];   // is added to the address
      port_q <= port_q && !(|mask_i[AddrBits-1:3]);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {bad_q, high_q, mismatch_q} <= '0;
      op_q <= '0;
    end else if (job_i == can_rn_pkg::JobHead || entry || aim_i || load_i) begin
      {bad_q, high_q, mismatch_q} <= {1'b0, (aim_i && (|aim_at_i[7:4]))
                                            || (load_i && !answer_i && (|load_at_i)), 1'b0};
      if (load_i) op_q[3:0] <= length_i;
      if (aim_i) op_q[3:0] <= aim_at_i[3:0];
      if (entry) op_q[3:0] <= read_i[3:0] & {4{read_i[7]}};   // one that is off has no length
    end else if (key_byte && !mapped_i) begin
      bad_q  <= bad_q || bad;
      high_q <= high_q || (second && !data && (|byte_i[7:4]));
      if (state ? other : ((&phase_i) && (|differ))
                          || (block && row_i[2] && !row_i[1] && (|byte_i))) mismatch_q <= 1'b1;
      if (get ? third : first)
        op_q <= {byte_i[4:3], byte_i[2] || (byte_i[7] && state), byte_i[1:0]};
    end
  end

endmodule
