// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The map against the tables of flexcan.md sections 1 and 3 and of time-spec.md section 6, copied
// here by hand: RTL, header and register tests are all made from sw/registers.yaml and would follow
// it into a mistake.
#include <gtest/gtest.h>

#include <cstdint>

#include "verican/verican_regs.h"

namespace {

struct Offset {
  const char *name;
  std::uint32_t map, specified;
};
#define AT(reg, offset) \
  Offset { #reg, VERICAN_##reg##_OFFSET, offset }
#define ENTRY(reg, n, offset) \
  Offset { #reg "[" #n "]", VERICAN_##reg##_OFFSET(n), offset }

TEST(RegisterMapSpec, Offsets) {  // flexcan.md 1, 3.1, 4
  for (const Offset &one : {AT(MCR, 0x000),
                            AT(CTRL1, 0x004),
                            AT(TIMER, 0x008),
                            AT(RXGMASK, 0x010),
                            AT(RX14MASK, 0x014),
                            AT(RX15MASK, 0x018),
                            AT(ECR, 0x01C),
                            AT(ESR1, 0x020),
                            AT(IMASK2, 0x024),
                            AT(IMASK1, 0x028),
                            AT(IFLAG2, 0x02C),
                            AT(IFLAG1, 0x030),
                            AT(CTRL2, 0x034),
                            AT(ESR2, 0x038),
                            AT(CRCR, 0x044),
                            AT(RXFGMASK, 0x048),
                            AT(RXFIR, 0x04C),
                            ENTRY(MB, 0, 0x080),
                            ENTRY(MB, 63, 0x470),
                            ENTRY(MB_CS, 63, 0x470),
                            ENTRY(MB_ID, 63, 0x474),
                            ENTRY(MB_DATA0, 63, 0x478),
                            ENTRY(MB_DATA1, 63, 0x47C),
                            ENTRY(RXIMR, 0, 0x880),
                            ENTRY(RXIMR, 63, 0x97C),
                            ENTRY(FIFO_FILTER, 0, 0x0E0),
                            ENTRY(FIFO_FILTER, 1, 0x0E4),
                            AT(XID, 0x1000),
                            AT(XVERSION, 0x1004),
                            AT(XCONFIG, 0x1008),
                            AT(XCTRL, 0x100C)})
    EXPECT_EQ(one.map, one.specified) << one.name;
}

TEST(RegisterMapSpec, ResetValues) {  // flexcan.md 1
  EXPECT_EQ(VERICAN_MCR_RESET, 0xD890000Fu);
  EXPECT_EQ(VERICAN_CTRL2_RESET, 0x00B00000u);
  for (std::uint32_t ones : {VERICAN_RXGMASK_RESET, VERICAN_RX14MASK_RESET, VERICAN_RX15MASK_RESET,
                             VERICAN_RXFGMASK_RESET})
    EXPECT_EQ(ones, 0xFFFFFFFFu);
  for (std::uint32_t zero :
       {VERICAN_CTRL1_RESET, VERICAN_TIMER_RESET, VERICAN_ECR_RESET, VERICAN_ESR1_RESET,
        VERICAN_IMASK2_RESET, VERICAN_IMASK1_RESET, VERICAN_IFLAG2_RESET, VERICAN_IFLAG1_RESET,
        VERICAN_ESR2_RESET, VERICAN_CRCR_RESET, VERICAN_RXFIR_RESET})
    EXPECT_EQ(zero, 0u);
}

TEST(RegisterMapSpec, TimeUnitOffsets) {  // TM section 6
  for (const Offset &one :
       {AT(TCAP, 0x1100),          AT(TCTRL, 0x1104),          AT(TSTAT, 0x1108),
        AT(TIMELO, 0x1110),        AT(TIMEHI, 0x1114),         AT(TINCN, 0x1118),
        AT(TINCF, 0x111C),         AT(TSHLO, 0x1120),          AT(TSHHI, 0x1124),
        AT(TSLEW, 0x1128),         AT(TCMP, 0x1130),           AT(TCMPH, 0x1134),
        AT(TTX, 0x1140),           AT(TTXMB, 0x1144),          AT(TEXTLO, 0x1150),
        AT(TEXTHI, 0x1154),        ENTRY(STAMPLO, 0, 0x1400),  ENTRY(STAMPHI, 0, 0x1404),
        ENTRY(STAMPLO, 1, 0x1408), ENTRY(STAMPLO, 63, 0x15F8), ENTRY(STAMPHI, 63, 0x15FC)})
    EXPECT_EQ(one.map, one.specified) << one.name;
}

struct Bits {
  const char *name;
  std::uint32_t map;
  unsigned high, low;
};
#define BITS(field, high, low) \
  Bits { #field, VERICAN_##field##_MASK, high, low }
#define BIT(field, bit) BITS(field, bit, bit)

void expect(std::initializer_list<Bits> fields) {
  for (const Bits &field : fields) {
    const std::uint64_t mask = (std::uint64_t{2} << field.high) - (std::uint64_t{1} << field.low);
    EXPECT_EQ(field.map, mask) << field.name;
  }
}

TEST(RegisterMapSpec, McrAndCtrl) {  // flexcan.md 1.1, 1.2, 1.6
  expect(
      {BIT(MCR_MDIS, 31),     BIT(MCR_FRZ, 30),     BIT(MCR_FEN, 29),      BIT(MCR_HALT, 28),
       BIT(MCR_NOT_RDY, 27),  BIT(MCR_WAK_MSK, 26), BIT(MCR_SOFT_RST, 25), BIT(MCR_FRZ_ACK, 24),
       BIT(MCR_SUPV, 23),     BIT(MCR_SLF_WAK, 22), BIT(MCR_WRN_EN, 21),   BIT(MCR_LPM_ACK, 20),
       BIT(MCR_WAK_SRC, 19),  BIT(MCR_DOZE, 18),    BIT(MCR_SRX_DIS, 17),  BIT(MCR_BCC, 16),
       BIT(MCR_LPRIO_EN, 13), BIT(MCR_AEN, 12),     BITS(MCR_IDAM, 9, 8),  BITS(MCR_MAXMB, 6, 0)});
  expect({BITS(CTRL1_PRESDIV, 31, 24), BITS(CTRL1_RJW, 23, 22), BITS(CTRL1_PSEG1, 21, 19),
          BITS(CTRL1_PSEG2, 18, 16), BIT(CTRL1_BOFF_MSK, 15), BIT(CTRL1_ERR_MSK, 14),
          BIT(CTRL1_CLK_SRC, 13), BIT(CTRL1_LPB, 12), BIT(CTRL1_TWRN_MSK, 11),
          BIT(CTRL1_RWRN_MSK, 10), BIT(CTRL1_SMP, 7), BIT(CTRL1_BOFF_REC, 6), BIT(CTRL1_TSYN, 5),
          BIT(CTRL1_LBUF, 4), BIT(CTRL1_LOM, 3), BITS(CTRL1_PROPSEG, 2, 0)});
  expect({BIT(CTRL2_WRMFRZ, 28), BITS(CTRL2_RFFN, 27, 24), BITS(CTRL2_TASD, 23, 19),
          BIT(CTRL2_MRP, 18), BIT(CTRL2_RRS, 17), BIT(CTRL2_EACEN, 16)});
}

TEST(RegisterMapSpec, Status) {  // flexcan.md 1.3, 1.4, 1.5, 1.7, 1.8
  expect({BITS(TIMER_TIMER, 15, 0), BITS(ECR_RXERR, 15, 8), BITS(ECR_TXERR, 7, 0)});
  expect({BIT(ESR1_SYNCH, 18), BIT(ESR1_TWRN_INT, 17), BIT(ESR1_RWRN_INT, 16),
          BIT(ESR1_BIT1_ERR, 15), BIT(ESR1_BIT0_ERR, 14), BIT(ESR1_ACK_ERR, 13),
          BIT(ESR1_CRC_ERR, 12), BIT(ESR1_FRM_ERR, 11), BIT(ESR1_STF_ERR, 10), BIT(ESR1_TX_WRN, 9),
          BIT(ESR1_RX_WRN, 8), BIT(ESR1_IDLE, 7), BIT(ESR1_TX, 6), BITS(ESR1_FLT_CONF, 5, 4),
          BIT(ESR1_RX, 3), BIT(ESR1_BOFF_INT, 2), BIT(ESR1_ERR_INT, 1), BIT(ESR1_WAK_INT, 0)});
  expect(
      {BIT(IFLAG1_FIFO_OVERFLOW, 7), BIT(IFLAG1_FIFO_WARNING, 6), BIT(IFLAG1_FIFO_AVAILABLE, 5)});
  expect({BITS(ESR2_LPTM, 22, 16), BIT(ESR2_VPS, 14), BIT(ESR2_IMB, 13), BITS(CRCR_MBCRC, 22, 16),
          BITS(CRCR_TXCRC, 14, 0), BITS(RXFIR_IDHIT, 8, 0)});
}

TEST(RegisterMapSpec, BuffersAndFilters) {  // flexcan.md 3.1, 4
  expect({BITS(MB_CS_CODE, 27, 24), BIT(MB_CS_SRR, 22), BIT(MB_CS_IDE, 21), BIT(MB_CS_RTR, 20),
          BITS(MB_CS_DLC, 19, 16), BITS(MB_CS_TIME_STAMP, 15, 0), BITS(MB_ID_PRIO, 31, 29),
          BITS(MB_ID_STD, 28, 18), BITS(MB_ID_EXT, 28, 0), BITS(MB_DATA0_BYTE0, 31, 24),
          BITS(MB_DATA0_BYTE3, 7, 0), BITS(MB_DATA1_BYTE0, 31, 24), BITS(MB_DATA1_BYTE3, 7, 0)});
  expect({BIT(FIFO_FILTER_A_REM, 31), BIT(FIFO_FILTER_A_EXT, 30),
          BITS(FIFO_FILTER_A_STD_ID, 29, 19), BITS(FIFO_FILTER_A_EXT_ID, 29, 1),
          BIT(FIFO_FILTER_B_REM0, 31), BIT(FIFO_FILTER_B_EXT0, 30),
          BITS(FIFO_FILTER_B_STD_ID0, 29, 19), BITS(FIFO_FILTER_B_EXT_ID0, 29, 16),
          BIT(FIFO_FILTER_B_REM1, 15), BIT(FIFO_FILTER_B_EXT1, 14),
          BITS(FIFO_FILTER_B_STD_ID1, 13, 3), BITS(FIFO_FILTER_B_EXT_ID1, 13, 0),
          BITS(FIFO_FILTER_C_ID0, 31, 24), BITS(FIFO_FILTER_C_ID1, 23, 16),
          BITS(FIFO_FILTER_C_ID2, 15, 8), BITS(FIFO_FILTER_C_ID3, 7, 0)});
}

TEST(RegisterMapSpec, TimeUnit) {  // TM section 6, TM-02
  EXPECT_EQ(VERICAN_TCAP_RESET, 0x00020003u);
  EXPECT_EQ(VERICAN_TCTRL_RESET, 0x00000031u);
  EXPECT_EQ(VERICAN_TCTRL_POINT_SOF, 0u);
  EXPECT_EQ(VERICAN_TCTRL_POINT_EDGE, 1u);
  EXPECT_EQ(VERICAN_TCTRL_POINT_EOF, 2u);
  expect({BIT(XCONFIG_TIME, 12), BITS(TCAP_SPLAT, 23, 16), BITS(TCAP_TXLAT, 15, 8),
          BITS(TCAP_RXLAT, 7, 0)});
  expect({BITS(TCTRL_POINT, 1, 0), BIT(TCTRL_TXPIN, 2), BITS(TCTRL_SLEWR, 5, 4), BIT(TCTRL_EXTR, 8),
          BIT(TCTRL_EXTF, 9), BIT(TCTRL_OUTEN, 12), BIT(TCTRL_CMPEN, 13), BIT(TCTRL_EXTIE, 16),
          BIT(TCTRL_CMPIE, 17), BIT(TCTRL_SLEWIE, 18), BIT(TCTRL_TXIE, 19), BIT(TCTRL_SYNCIE, 20)});
  expect({BIT(TSTAT_EXT, 0), BIT(TSTAT_EXTOVR, 1), BIT(TSTAT_CMP, 2), BIT(TSTAT_SLEWD, 3),
          BIT(TSTAT_TXREL, 4), BIT(TSTAT_SYNC, 5), BIT(TSTAT_SLEWING, 16), BIT(TSTAT_HELD, 17),
          BIT(TSTAT_OUT, 18), BIT(TSTAT_CMPON, 19)});
  expect({BITS(TIMELO_TIMELO, 31, 0), BITS(TIMEHI_TIMEHI, 31, 0), BITS(TINCN_TINCN, 7, 0),
          BITS(TINCF_TINCF, 31, 0), BITS(TSHLO_TSHLO, 31, 0), BITS(TSHHI_TSHHI, 31, 0),
          BITS(TSLEW_TSLEW, 31, 0), BITS(TCMP_TCMP, 31, 0), BITS(TCMPH_TCMPH, 30, 0),
          BITS(TTX_TTX, 31, 0), BIT(TTXMB_HOLD, 31), BITS(TTXMB_MB, 5, 0),
          BITS(TEXTLO_TEXTLO, 31, 0), BITS(TEXTHI_TEXTHI, 31, 0)});
}

TEST(RegisterMapSpec, NamedValues) {  // flexcan.md 1.1, 1.4, 3.2
  EXPECT_EQ(VERICAN_MB_CS_CODE_RX_INACTIVE, 0b0000u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_RX_EMPTY, 0b0100u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_RX_FULL, 0b0010u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_RX_OVERRUN, 0b0110u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_TX_INACTIVE, 0b1000u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_TX_ABORT, 0b1001u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_TX_DATA, 0b1100u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_TX_ANSWER, 0b1010u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_TX_ANSWERING, 0b1110u);
  EXPECT_EQ(VERICAN_ESR1_FLT_CONF_ACTIVE, 0u);
  EXPECT_EQ(VERICAN_ESR1_FLT_CONF_PASSIVE, 1u);
  EXPECT_EQ(VERICAN_ESR1_FLT_CONF_BUS_OFF, 2u);
  EXPECT_EQ(VERICAN_MCR_IDAM_FORMAT_A, 0u);
  EXPECT_EQ(VERICAN_MCR_IDAM_FORMAT_B, 1u);
  EXPECT_EQ(VERICAN_MCR_IDAM_FORMAT_C, 2u);
  EXPECT_EQ(VERICAN_MCR_IDAM_REJECT, 3u);
}

TEST(RegisterMapSpec, GetAndSetCutToTheField) {
  EXPECT_EQ(VERICAN_CTRL1_PSEG1_SET(0xFFu), 0x00380000u);
  EXPECT_EQ(VERICAN_CTRL1_PSEG1_GET(0xFFFFFFFFu), 7u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_SET(0x1Cu), 0x0C000000u);
  EXPECT_EQ(VERICAN_MB_CS_CODE_GET(0xF8FFFFFFu), 8u);
  EXPECT_EQ(VERICAN_RXIMR_MI_SET(0x12345678u), 0x12345678u);
}

}  // namespace
