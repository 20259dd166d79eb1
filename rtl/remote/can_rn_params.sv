// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_params: checks the parameters of can_remote at elaboration. An illegal value instantiates
// a module that does not exist; its name is the error message. This also works in tools that do not
// support $error at elaboration.

module can_rn_params #(
  parameter int NameBits = 3,
  parameter int MemBytes = 4096,
  parameter int StageBytes = 8,
  parameter int TxDepth = 1,
  parameter int NumProd = 0,
  parameter int NumMap = 0,
  parameter int Protect = 0,
  parameter int Block = 0,
  parameter int AutoRate = 0,
  parameter int Counters = 0,
  parameter int SameId = 0,
  parameter int Trace = 0,
  parameter int RateRows = 8,
  parameter int TimeSync = 0,
  parameter logic [39:0] TimeInc = '0,
  parameter logic [31:0] SyncCtrl = '0,
  parameter logic [31:0] SyncId = '0,
  parameter logic [31:0] SyncDelay = '0,
  parameter int HalfPeriod = 1
) ();
  if (NameBits != 3 && NameBits != 5) begin : gen_check_name_bits
    NameBits_must_be_3_or_5 u_stop ();
  end
  if (MemBytes != 1024 && MemBytes != 2048 && MemBytes != 4096) begin : gen_check_mem_bytes
    MemBytes_must_be_1024_2048_or_4096 u_stop ();
  end
  if (StageBytes != 0 && StageBytes != 8 && StageBytes != 16) begin : gen_check_stage_bytes
    StageBytes_must_be_0_8_or_16 u_stop ();
  end
  if (TxDepth != 1 && TxDepth != 4) begin : gen_check_tx_depth
    TxDepth_must_be_1_or_4 u_stop ();
  end
  if (NumProd != 0 && NumProd != 4 && NumProd != 8) begin : gen_check_num_prod
    NumProd_must_be_0_4_or_8 u_stop ();
  end
  if (NumMap != 0 && NumMap != 4 && NumMap != 8) begin : gen_check_num_map
    NumMap_must_be_0_4_or_8 u_stop ();
  end
  if (Protect != 0 && Protect != 1) begin : gen_check_protect
    Protect_must_be_0_or_1 u_stop ();
  end
  if (Block != 0 && Block != 1) begin : gen_check_block
    Block_must_be_0_or_1 u_stop ();
  end
  if (AutoRate != 0 && AutoRate != 1) begin : gen_check_auto_rate
    AutoRate_must_be_0_or_1 u_stop ();
  end
  if (Counters != 0 && Counters != 1) begin : gen_check_counters
    Counters_must_be_0_or_1 u_stop ();
  end
  if (SameId != 0 && SameId != 1) begin : gen_check_same_id
    SameId_must_be_0_or_1 u_stop ();
  end
  if (Trace != 0 && Trace != 1) begin : gen_check_trace
    Trace_must_be_0_or_1 u_stop ();
  end
  if (RateRows < 1 || RateRows > 15) begin : gen_check_rate_rows
    RateRows_must_be_1_to_15 u_stop ();
  end
  if (TimeSync != 0 && TimeSync != 1) begin : gen_check_time_sync
    TimeSync_must_be_0_or_1 u_stop ();
  end
  // The ByteWise engine of a node only reports the first 11 bits of an identifier.
  if (SyncId[31:29] != '0 || SyncId[17:0] != '0) begin : gen_check_sync_id
    SyncId_must_be_a_base_identifier_in_bits_28_to_18 u_stop ();
  end
  can_time_params #(
    .TimeInc(TimeInc), .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay),
    .HalfPeriod(HalfPeriod)
  ) u_time_params ();
endmodule
