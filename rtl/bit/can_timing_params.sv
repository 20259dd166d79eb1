// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_timing_params: checks bit timing parameters of nodes without a processor (BT-02, BT-03) at
// elaboration. An illegal value instantiates a module that does not exist; its name is the error
// message. This also works in tools that do not support $error at elaboration.

module can_timing_params #(
  /// Clocks per time quantum.
  parameter int Brp = 1,
  /// Time quanta of PROP_SEG, PHASE_SEG1 and PHASE_SEG2; SJW, at most the shorter of the last two.
  parameter int Prop = 1,
  parameter int Ps1 = 4,
  parameter int Ps2 = 2,
  parameter int Sjw = 1
) ();
  if (Brp < 1 || Brp > 256) begin : gen_check_brp
    Brp_must_be_1_to_256 u_stop ();
  end
  if (Prop < 1 || Prop > 8) begin : gen_check_prop
    Prop_must_be_1_to_8 u_stop ();
  end
  if (Ps1 < 1 || Ps1 > 8) begin : gen_check_ps1
    Ps1_must_be_1_to_8 u_stop ();
  end
  if (Ps2 < 1 || Ps2 > 8) begin : gen_check_ps2
    Ps2_must_be_1_to_8 u_stop ();
  end
  if (Sjw < 1 || Sjw > 4) begin : gen_check_sjw
    Sjw_must_be_1_to_4 u_stop ();
  end
  if (Sjw > Ps1 || Sjw > Ps2) begin : gen_check_jump
    Sjw_must_be_at_most_Ps1_and_Ps2 u_stop ();
  end
  if (Brp * (1 + Prop + Ps1 + Ps2) < 8) begin : gen_check_bit
    Bit_must_have_8_clocks u_stop ();
  end
endmodule
