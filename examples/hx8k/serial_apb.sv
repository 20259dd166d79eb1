// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// serial_apb: an APB master at a serial line, 8N1, in the protocol of LiteX's UARTBone: command (1
// write, 2 read, both with growing addresses; 3 write, 4 read, at one address), number of words,
// word address (4 bytes) and the words that are written; the words that are read come back. Most
// significant byte first. Other commands are dropped, and one that is cut off after Silence clocks
// without a byte. PSLVERR is not told: such words read as 0.

module serial_apb #(
  /// Clocks of a bit, 4 or more; 104: 115,200 bit/s of 12 MHz.
  parameter int BitClocks = 104,
  /// Clocks after which a command that is cut off is dropped; 100 ms.
  parameter int Silence = 1_200_000
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        rx_i,          // asynchronous
  output logic        tx_o,
  output logic        psel_o,
  output logic        penable_o,
  output logic [31:0] paddr_o,
  output logic        pwrite_o,
  output logic [31:0] pwdata_o,
  input  logic        pready_i,
  input  logic [31:0] prdata_i
);
  localparam int BitWidth = $clog2(BitClocks + 1);
  localparam int SilenceWidth = $clog2(Silence + 1);
  localparam logic [BitWidth-1:0] Bit  = BitWidth'(BitClocks - 1);
  localparam logic [BitWidth-1:0] Half = BitWidth'(BitClocks / 2);

  logic [31:0] data_q;               // a word on its way

  // Receiver: a start bit is looked at again in its middle, then come the middles of nine bits.
  logic [1:0]          sync_q;
  logic                rx_busy_q, rx_tick, rx_done;
  logic [BitWidth-1:0] rx_clocks_q;
  logic [3:0]          rx_bits_q;
  logic [7:0]          rx_q;
  assign rx_tick = rx_busy_q && rx_clocks_q == '0;
  assign rx_done = rx_tick && rx_bits_q == 4'd9 && sync_q[1];       // a stop bit, or no byte
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sync_q <= '1;
      {rx_busy_q, rx_clocks_q, rx_bits_q, rx_q} <= '0;
    end else begin
      sync_q <= {sync_q[0], rx_i};
      if (!rx_busy_q) begin
        rx_busy_q   <= !sync_q[1];
        rx_clocks_q <= Half;
        rx_bits_q   <= '0;
      end else if (!rx_tick) begin
        rx_clocks_q <= rx_clocks_q - 1'b1;
      end else begin
        rx_clocks_q <= Bit;
        rx_bits_q   <= rx_bits_q + 1'b1;
        if (rx_bits_q != 4'd9) rx_q <= {sync_q[1], rx_q[7:1]};
        if (rx_bits_q == 4'd9 || (rx_bits_q == '0 && sync_q[1])) rx_busy_q <= 1'b0;
      end
    end
  end

  // Transmitter: start bit, byte, stop bit.
  logic                tx_start, tx_busy;
  logic [BitWidth-1:0] tx_clocks_q;
  logic [3:0]          tx_left_q;
  logic [8:0]          tx_q;
  assign tx_busy = tx_left_q != '0;
  assign tx_o    = tx_q[0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {tx_clocks_q, tx_left_q} <= '0;
      tx_q <= '1;
    end else if (tx_start) begin
      tx_clocks_q <= Bit;
      tx_left_q   <= 4'd10;
      tx_q        <= {data_q[31:24], 1'b0};
    end else if (tx_busy) begin
      tx_clocks_q <= tx_clocks_q == '0 ? Bit : tx_clocks_q - 1'b1;
      if (tx_clocks_q == '0) begin
        tx_left_q <= tx_left_q - 1'b1;
        tx_q      <= {1'b1, tx_q[8:1]};
      end
    end
  end

  // The command.
  localparam logic [2:0] StCommand = 3'd0, StLength = 3'd1, StAddress = 3'd2, StData = 3'd3,
                         StSetup = 3'd4, StAccess = 3'd5, StSend = 3'd6;
  logic [2:0]  state_q;
  logic        fixed_q, last;
  logic [1:0]  byte_q;               // of a word
  logic [7:0]  words_q;              // still to come
  logic [29:0] addr_q;
  logic [SilenceWidth-1:0] silence_q;
  assign last      = byte_q == 2'd3;
  assign psel_o    = state_q == StSetup || state_q == StAccess;
  assign penable_o = state_q == StAccess;
  assign paddr_o   = {addr_q, 2'b00};
  assign pwdata_o  = data_q;
  assign tx_start  = state_q == StSend && !tx_busy;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StCommand;
      {pwrite_o, fixed_q, byte_q, words_q, addr_q, data_q, silence_q} <= '0;
    end else begin
      silence_q <= rx_done || state_q == StCommand ? '0 : silence_q + 1'b1;
      case (state_q)
        StCommand: if (rx_done && rx_q >= 8'd1 && rx_q <= 8'd4) begin
          {fixed_q, pwrite_o} <= {rx_q > 8'd2, rx_q[0]};
          state_q <= StLength;
        end
        StLength: if (rx_done) begin
          words_q <= rx_q;
          state_q <= rx_q == '0 ? StCommand : StAddress;
        end
        StAddress, StData: if (rx_done) begin
          byte_q <= byte_q + 1'b1;
          if (state_q == StData) data_q <= {data_q[23:0], rx_q};
          else                   addr_q <= {addr_q[21:0], rx_q};
          if (last) state_q <= state_q == StAddress && pwrite_o ? StData : StSetup;
        end
        StSetup: state_q <= StAccess;
        StAccess: if (pready_i) begin
          if (!pwrite_o) data_q <= prdata_i;
          if (!fixed_q)  addr_q <= addr_q + 1'b1;
          words_q <= words_q - 1'b1;
          state_q <= !pwrite_o ? StSend : words_q == 8'd1 ? StCommand : StData;
        end
        default: if (tx_start) begin                                // StSend
          byte_q <= byte_q + 1'b1;
          data_q <= {data_q[23:0], 8'd0};
          if (last) state_q <= words_q == '0 ? StCommand : StSetup;
        end
      endcase
      if (silence_q == SilenceWidth'(Silence) && state_q <= StData) begin
        state_q <= StCommand;
        byte_q  <= '0;
      end
    end
  end
endmodule
