// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_tq_gen: prescaler that divides the system clock into time quanta, the clock generator of the
// paper (BT-01). It gives a clock enable, because derived clocks would cost timing closure.

module can_tq_gen #(
  /// Width of the prescaler, 1 to 16 bits; 8 as in CTRL.PRESDIV. 0: no prescaler, every clock is a
  /// time quantum.
  parameter int PresdivWidth = 8,
  /// Derived, do not override.
  localparam int Width = PresdivWidth == 0 ? 1 : PresdivWidth
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             run_i,      // 0: stopped; the next time quantum has its full length
  input  logic [Width-1:0] presdiv_i,  // clocks per time quantum minus one
  output logic             tq_o        // pulse: last clock of each time quantum
);

  if (PresdivWidth < 0 || PresdivWidth > 16) begin : gen_check_presdiv_width
    PresdivWidth_must_be_0_to_16 u_stop ();
  end

  if (PresdivWidth == 0) begin : gen_every_clock
    logic unused;
    assign unused = &{1'b0, clk_i, rst_ni, run_i, presdiv_i};
    assign tq_o   = 1'b1;
  end else begin : gen_divide
    logic [Width-1:0] count_q;  // clocks of the present time quantum

    // tq_o is registered, because the longest paths of the core start here. After an upset of the
    // count, the time quantum ends within one full length.
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        count_q <= '0;
        tq_o    <= 1'b0;
      end else if (!run_i || tq_o) begin
        count_q <= Width'(1);
        tq_o    <= (presdiv_i == '0);  // while stopped nobody looks at it
      end else begin
        count_q <= count_q + 1'b1;
        tq_o    <= (count_q >= presdiv_i);
      end
    end
  end

endmodule
