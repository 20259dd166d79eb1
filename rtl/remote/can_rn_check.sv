// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_check: decodes the request and checks it (section 4 of remote-node.md, RN-30 to RN-33).
// The first check that fails gives the code, in the order function, value, sequence, address, lock,
// protection, busy. The code is registered and final before the frame is valid.

module can_rn_check #(
  parameter int NameBits = 3,
  parameter int MemBytes = 4096,
  parameter int NumProd = 0,
  parameter int NumMap = 0,
  parameter bit Counters = 1'b0,
  parameter bit Block = 1'b0,
  parameter bit Clock = 1'b0,
  /// Derived, do not override.
  localparam int AddrBits = 10 - NameBits
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  // Request
  input  logic                sys_i,          // system function (name 0)
  input  logic                all_i,          // request to all nodes (name 1)
  input  logic                port_i,         // A is a port
  input  logic [AddrBits-1:0] a_i,            // A
  input  logic                rtr_i,          // remote frame, or visit of a producer
  input  logic [3:0]          dlc_i,          // DLC, or length of the frame that is made
  input  logic                mapped_i,       // a map entry has taken the frame
  input  logic                short_i,        // map entry: DLC is too short, or above 8
  input  logic                unlock_i,       // SETUP is UNLOCK
  input  logic                op_i,           // BLOCK opens a transfer (op is not 0)
  input  logic                value_bad_i,    // a byte has an illegal value
  input  logic                high_bad_i,     // address beyond 12 bits
  input  logic                mismatch_i,     // serial or number differs; BLOCK: count not 0
  input  logic [11:0]         start_i,        // first address of the access
  input  logic [3:0]          end_i,          // index behind the last byte of the row
  // Block transfer
  input  logic                make_i,         // a frame of a block transfer is made
  input  logic                busy_i,         // a transfer is open or its answer not yet sent
  input  logic                order_i,        // DATA has the expected sequence number
  input  logic                again_i,        // DATA repeats the last frame
  input  logic                over_i,         // DATA has more bytes than are left
  // Node
  input  logic                selected_i,     // node is selected (SELECT)
  input  logic                operate_i,      // node is in OPERATE
  input  logic                unlocked_i,     // node is unlocked
  input  logic                lock_reset_i,   // node is locked until reset
  input  logic                full_i,         // queue has no room for an answer
  input  logic                denied_i,       // a byte is protected (WP, RP)
  // Kind of request, good while its code is 0
  output logic                write_o,        // writes memory; one clock later than the others
  output logic                read_o,         // reads memory; one clock later than the others
  output logic                trigger_o,      // TRIGGER; one clock later than the others
  output logic                stage_o,        // TRIGGER, as early as the others
  output logic                select_o,       // SELECT or SELECT NEW
  output logic                assign_o,       // ASSIGN
  output logic                state_o,        // STATE
  output logic                setup_o,        // SETUP
  output logic                far_o,          // READ or WRITE: the row begins with the address
  output logic                info_o,         // STATUS or IDENT
  output logic                block_o,        // BLOCK
  output logic                data_o,         // DATA
  output logic                crosses_o,      // access ends in the next block of eight bytes
  output logic [3:0]          code_o          // result code, registered
);
  logic near, is_write, none, make, write, read, trigger, write_q, read_q, trigger_q;
  assign make      = Block && make_i;
  assign near      = !sys_i && !port_i;
  assign far_o     = port_i && !(|a_i[2:1]);
  assign info_o    = port_i && (&a_i[2:1]);
  assign block_o   = Block && port_i && a_i[2:0] == 3'd2;
  assign data_o    = Block && port_i && a_i[2:0] == 3'd3;
  assign is_write  = (far_o && a_i[0]) || (data_o && !make);
  assign write     = is_write || (near && !rtr_i && !(mapped_i && none));
  assign read      = (far_o && !a_i[0]) || (near && rtr_i) || info_o || make;
  assign write_o   = write_q;           // what is moved, where to: known long before it moves
  assign read_o    = read_q;
  assign trigger_o = trigger_q;
  assign stage_o   = trigger;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {write_q, read_q, trigger_q} <= '0;
    end else begin
      {write_q, read_q, trigger_q} <= {write, read, trigger};
    end
  end
  assign setup_o   = port_i && a_i[2:1] == 2'd2;
  assign state_o   = sys_i && !(|a_i[2:0]);
  assign trigger   = sys_i && a_i[1:0] == 2'd1;
  assign assign_o  = sys_i && (&a_i[1:0]);
  assign select_o  = sys_i && !a_i[0] && (|a_i[2:1]);

  // RN-32: illegal function, illegal value
  logic bad_function, bad_value, long, third;
  assign none  = !(|dlc_i);
  assign long  = dlc_i[3] && (|dlc_i[2:0]);
  assign third = dlc_i[3:2] != 2'b00;   // 4 or more
  always_comb begin
    bad_function = port_i && (info_o ? !rtr_i : rtr_i || (a_i[1] && (!Block || all_i))
                                                || (a_i[2] && (a_i[0] || all_i)));
    bad_value    = mapped_i ? short_i : none || long;
    if (sys_i) begin
      bad_function = rtr_i || (|a_i[AddrBits-1:3]) || (a_i[2] && (|a_i[1:0]));
      if (trigger)        bad_value = third || dlc_i[1];
      else if (select_o)  bad_value = !dlc_i[3] || long;
      else                bad_value = third || (assign_o ? dlc_i[1:0] != 2'd1
                                                         : !(dlc_i[1] ^ dlc_i[0]));
    end
    if (far_o && !(&dlc_i[1:0] && !third)) bad_value = !is_write || long || !third;
    if (setup_o) bad_value = dlc_i[3] || dlc_i[1] || !dlc_i[0] || dlc_i[2] != unlock_i;
    if (data_o) bad_value = long || !(third || dlc_i[1]) || (over_i && !again_i && !make);
    if (block_o && !make) bad_value = dlc_i[3] || !(&dlc_i[2:1]) || (op_i && !mismatch_i);
    if (value_bad_i && !(state_o && mismatch_i)) bad_value = 1'b1;
  end

  // RN-32: illegal address. An access may cross into the next block of eight bytes, except at the
  // end of a legal area.
  logic       crosses, top, producer, map, config_area, ends, fixed_area, outside, last;
  logic       bad_address;
  logic [3:0] reach;
  assign reach       = {1'b0, start_i[2:0]} + end_i;
  assign crosses     = reach[3] && (reach[2] || (reach[1] && (!far_o || reach[0]))
                                    || (reach[0] && !far_o && !data_o));
  assign crosses_o   = crosses;
  assign top         = &start_i[11:8];
  assign config_area = top && (!(|start_i[7:5]) || producer || map);
  assign fixed_area  = top && ((&start_i[7:4])
                               || (Counters && (&start_i[7:5]) && !start_i[4] && start_i[3])
                               || (Clock && start_i[7:4] == 4'hC));
  // Tables have eight bytes per entry. ends: the block is the last of an area with none behind it.
  assign producer = NumProd != 0 && start_i[7:6] == 2'd1 && (NumProd == 8 || !start_i[5]);
  assign map      = NumMap != 0 && start_i[7:6] == 2'd2 && (NumMap == 8 || !start_i[5]);
  assign ends     = top && (start_i[7:3] == 5'b00011
                            || (NumProd == 4 && start_i[7:3] == 5'b01011)
                            || (NumProd == 8 && NumMap == 0 && start_i[7:3] == 5'b01111)
                            || (NumMap == 4 && start_i[7:3] == 5'b10011)
                            || (NumMap == 8 && start_i[7:3] == 5'b10111)
                            || (Clock && start_i[7:3] == 5'b11001));
  if (MemBytes == 4096) begin : gen_whole
    assign outside = (&start_i[11:9]) && !config_area && !fixed_area;
    assign last    = (&start_i[11:10]) && (&start_i[8:3]);
  end else begin : gen_part
    assign outside = (&start_i[11:9]) ? !config_area && !fixed_area
                                      : start_i[11:9] >= 3'(MemBytes / 512 - 1);
    assign last    = ((&start_i[11:9]) || start_i[11:9] == 3'(MemBytes / 512 - 2))
                     && (&start_i[8:3]);
  end
  always_comb begin
    if (far_o || data_o || mapped_i) bad_address = high_bad_i || outside
                             || (crosses && (last || ends));
    else       bad_address = near && crosses && (&start_i[AddrBits-1:4]) && !start_i[3];
  end

  logic locked;
  assign locked = ((is_write || mapped_i) && config_area && !unlocked_i)
                  || (setup_o && unlock_i && (mismatch_i || operate_i || lock_reset_i))
                  || (assign_o && selected_i && operate_i);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                        code_o <= can_rn_pkg::CodeOk;
    else if (bad_function)              code_o <= can_rn_pkg::CodeFunction;
    else if (bad_value)                 code_o <= can_rn_pkg::CodeValue;
    else if (Block && again_i)          code_o <= can_rn_pkg::CodeOk;
    else if (data_o && !make && !order_i) code_o <= can_rn_pkg::CodeSequence;
    else if (bad_address)               code_o <= can_rn_pkg::CodeAddress;
    else if (locked)                    code_o <= can_rn_pkg::CodeLocked;
    else if (denied_i || ((is_write || mapped_i) && fixed_area))
                                        code_o <= can_rn_pkg::CodeProtected;
    else if (read_o && full_i)          code_o <= can_rn_pkg::CodeBusy;
    else if (block_o && !make && op_i && (busy_i || full_i)) code_o <= can_rn_pkg::CodeBusy;
    else                                code_o <= can_rn_pkg::CodeOk;
  end

endmodule
