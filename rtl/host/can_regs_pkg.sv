// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_regs_pkg: the register map as constants. Written by tools/registers.py from
// sw/registers.yaml; edits are lost. <Reg>Addr counts words; <Reg><Field> is the lowest bit of a
// field and <Reg><Field>W its width, if it has more than one; <Reg><Field><Value> is a value that
// has a name; <Reg>Any, Freeze, Disable and WrnEn are the bits that a write changes at any time, in
// freeze mode, in disable mode, with MCR.WRN_EN.
// Of a core that says xconfig of itself: <reg>_has() are the bits that it has of a register,
// <reg>_without() is what those read that it has not.

package can_regs_pkg;

  // MCR: Module configuration
  localparam logic [10:0] McrAddr           = 11'h000;
  localparam logic [31:0] McrReset          = 32'hD890_000F;
  localparam logic [31:0] McrAny            = 32'hD444_0000;
  localparam logic [31:0] McrFreeze         = 32'h20AB_337F;
  localparam int          McrMdis           = 31;
  localparam int          McrFrz            = 30;
  localparam int          McrFen            = 29;
  localparam int          McrHalt           = 28;
  localparam int          McrNotRdy         = 27;
  localparam int          McrWakMsk         = 26;
  localparam int          McrSoftRst        = 25;
  localparam int          McrFrzAck         = 24;
  localparam int          McrSupv           = 23;
  localparam int          McrSlfWak         = 22;
  localparam int          McrWrnEn          = 21;
  localparam int          McrLpmAck         = 20;
  localparam int          McrWakSrc         = 19;
  localparam int          McrDoze           = 18;
  localparam int          McrSrxDis         = 17;
  localparam int          McrBcc            = 16;
  localparam int          McrLprioEn        = 13;
  localparam int          McrAen            = 12;
  localparam int          McrIdam           = 8;
  localparam int          McrIdamW          = 2;
  localparam logic [1:0]  McrIdamFormatA    = 2'h0;
  localparam logic [1:0]  McrIdamFormatB    = 2'h1;
  localparam logic [1:0]  McrIdamFormatC    = 2'h2;
  localparam logic [1:0]  McrIdamReject     = 2'h3;
  localparam int          McrMaxmb          = 0;
  localparam int          McrMaxmbW         = 7;

  // CTRL1: Bit timing, interrupt masks and bus behaviour
  localparam logic [10:0] Ctrl1Addr         = 11'h001;
  localparam logic [31:0] Ctrl1Reset        = 32'h0000_0000;
  localparam logic [31:0] Ctrl1Any          = 32'h0000_C040;
  localparam logic [31:0] Ctrl1Freeze       = 32'hFFFF_10BF;
  localparam logic [31:0] Ctrl1Disable      = 32'h0000_2000;
  localparam logic [31:0] Ctrl1WrnEn        = 32'h0000_0C00;
  localparam int          Ctrl1Presdiv      = 24;
  localparam int          Ctrl1PresdivW     = 8;
  localparam int          Ctrl1Rjw          = 22;
  localparam int          Ctrl1RjwW         = 2;
  localparam int          Ctrl1Pseg1        = 19;
  localparam int          Ctrl1Pseg1W       = 3;
  localparam int          Ctrl1Pseg2        = 16;
  localparam int          Ctrl1Pseg2W       = 3;
  localparam int          Ctrl1BoffMsk      = 15;
  localparam int          Ctrl1ErrMsk       = 14;
  localparam int          Ctrl1ClkSrc       = 13;
  localparam int          Ctrl1Lpb          = 12;
  localparam int          Ctrl1TwrnMsk      = 11;
  localparam int          Ctrl1RwrnMsk      = 10;
  localparam int          Ctrl1Smp          = 7;
  localparam int          Ctrl1BoffRec      = 6;
  localparam int          Ctrl1Tsyn         = 5;
  localparam int          Ctrl1Lbuf         = 4;
  localparam int          Ctrl1Lom          = 3;
  localparam int          Ctrl1Propseg      = 0;
  localparam int          Ctrl1PropsegW     = 3;

  // TIMER: Free-running timer
  localparam logic [10:0] TimerAddr         = 11'h002;
  localparam logic [31:0] TimerReset        = 32'h0000_0000;
  localparam logic [31:0] TimerAny          = 32'h0000_FFFF;
  localparam int          TimerTimer        = 0;
  localparam int          TimerTimerW       = 16;

  // RXGMASK: Receive mask of all buffers but 14 and 15
  localparam logic [10:0] RxgmaskAddr       = 11'h004;
  localparam logic [31:0] RxgmaskReset      = 32'hFFFF_FFFF;
  localparam logic [31:0] RxgmaskFreeze     = 32'hFFFF_FFFF;
  localparam int          RxgmaskMg         = 0;
  localparam int          RxgmaskMgW        = 32;

  // RX14MASK: Receive mask of buffer 14
  localparam logic [10:0] Rx14maskAddr      = 11'h005;
  localparam logic [31:0] Rx14maskReset     = 32'hFFFF_FFFF;
  localparam logic [31:0] Rx14maskFreeze    = 32'hFFFF_FFFF;
  localparam int          Rx14maskRx14m     = 0;
  localparam int          Rx14maskRx14mW    = 32;

  // RX15MASK: Receive mask of buffer 15
  localparam logic [10:0] Rx15maskAddr      = 11'h006;
  localparam logic [31:0] Rx15maskReset     = 32'hFFFF_FFFF;
  localparam logic [31:0] Rx15maskFreeze    = 32'hFFFF_FFFF;
  localparam int          Rx15maskRx15m     = 0;
  localparam int          Rx15maskRx15mW    = 32;

  // ECR: Error counters
  localparam logic [10:0] EcrAddr           = 11'h007;
  localparam logic [31:0] EcrReset          = 32'h0000_0000;
  localparam logic [31:0] EcrFreeze         = 32'h0000_FFFF;
  localparam int          EcrRxerr          = 8;
  localparam int          EcrRxerrW         = 8;
  localparam int          EcrTxerr          = 0;
  localparam int          EcrTxerrW         = 8;

  // ESR1: Errors and status
  localparam logic [10:0] Esr1Addr          = 11'h008;
  localparam logic [31:0] Esr1Reset         = 32'h0000_0000;
  localparam int          Esr1Synch         = 18;
  localparam int          Esr1TwrnInt       = 17;
  localparam int          Esr1RwrnInt       = 16;
  localparam int          Esr1Bit1Err       = 15;
  localparam int          Esr1Bit0Err       = 14;
  localparam int          Esr1AckErr        = 13;
  localparam int          Esr1CrcErr        = 12;
  localparam int          Esr1FrmErr        = 11;
  localparam int          Esr1StfErr        = 10;
  localparam int          Esr1TxWrn         = 9;
  localparam int          Esr1RxWrn         = 8;
  localparam int          Esr1Idle          = 7;
  localparam int          Esr1Tx            = 6;
  localparam int          Esr1FltConf       = 4;
  localparam int          Esr1FltConfW      = 2;
  localparam logic [1:0]  Esr1FltConfActive = 2'h0;
  localparam logic [1:0]  Esr1FltConfPassive = 2'h1;
  localparam logic [1:0]  Esr1FltConfBusOff = 2'h2;
  localparam int          Esr1Rx            = 3;
  localparam int          Esr1BoffInt       = 2;
  localparam int          Esr1ErrInt        = 1;
  localparam int          Esr1WakInt        = 0;

  // IMASK2: Interrupt masks of buffers 32 to 63
  localparam logic [10:0] Imask2Addr        = 11'h009;
  localparam logic [31:0] Imask2Reset       = 32'h0000_0000;
  localparam logic [31:0] Imask2Any         = 32'hFFFF_FFFF;
  localparam int          Imask2Bufm        = 0;
  localparam int          Imask2BufmW       = 32;

  // IMASK1: Interrupt masks of buffers 0 to 31
  localparam logic [10:0] Imask1Addr        = 11'h00A;
  localparam logic [31:0] Imask1Reset       = 32'h0000_0000;
  localparam logic [31:0] Imask1Any         = 32'hFFFF_FFFF;
  localparam int          Imask1Bufm        = 0;
  localparam int          Imask1BufmW       = 32;

  // IFLAG2: Interrupt flags of buffers 32 to 63
  localparam logic [10:0] Iflag2Addr        = 11'h00B;
  localparam logic [31:0] Iflag2Reset       = 32'h0000_0000;
  localparam int          Iflag2Bufi        = 0;
  localparam int          Iflag2BufiW       = 32;

  // IFLAG1: Interrupt flags of buffers 0 to 31
  localparam logic [10:0] Iflag1Addr        = 11'h00C;
  localparam logic [31:0] Iflag1Reset       = 32'h0000_0000;
  localparam int          Iflag1Bufi        = 0;
  localparam int          Iflag1BufiW       = 32;
  localparam int          Iflag1FifoOverflow = 7;
  localparam int          Iflag1FifoWarning = 6;
  localparam int          Iflag1FifoAvailable = 5;

  // CTRL2: Control 2
  localparam logic [10:0] Ctrl2Addr         = 11'h00D;
  localparam logic [31:0] Ctrl2Reset        = 32'h00B0_0000;
  localparam logic [31:0] Ctrl2Freeze       = 32'h1FFF_0000;
  localparam int          Ctrl2Wrmfrz       = 28;
  localparam int          Ctrl2Rffn         = 24;
  localparam int          Ctrl2RffnW        = 4;
  localparam int          Ctrl2Tasd         = 19;
  localparam int          Ctrl2TasdW        = 5;
  localparam int          Ctrl2Mrp          = 18;
  localparam int          Ctrl2Rrs          = 17;
  localparam int          Ctrl2Eacen        = 16;

  // ESR2: State of the transmit arbitration
  localparam logic [10:0] Esr2Addr          = 11'h00E;
  localparam logic [31:0] Esr2Reset         = 32'h0000_0000;
  localparam int          Esr2Lptm          = 16;
  localparam int          Esr2LptmW         = 7;
  localparam int          Esr2Vps           = 14;
  localparam int          Esr2Imb           = 13;

  // CRCR: CRC of the last frame sent
  localparam logic [10:0] CrcrAddr          = 11'h011;
  localparam logic [31:0] CrcrReset         = 32'h0000_0000;
  localparam int          CrcrMbcrc         = 16;
  localparam int          CrcrMbcrcW        = 7;
  localparam int          CrcrTxcrc         = 0;
  localparam int          CrcrTxcrcW        = 15;

  // RXFGMASK: Mask of FIFO filters without a mask of their own
  localparam logic [10:0] RxfgmaskAddr      = 11'h012;
  localparam logic [31:0] RxfgmaskReset     = 32'hFFFF_FFFF;
  localparam logic [31:0] RxfgmaskFreeze    = 32'hFFFF_FFFF;
  localparam int          RxfgmaskFgm       = 0;
  localparam int          RxfgmaskFgmW      = 32;

  // RXFIR: Filter of the frame at the FIFO's output
  localparam logic [10:0] RxfirAddr         = 11'h013;
  localparam logic [31:0] RxfirReset        = 32'h0000_0000;
  localparam int          RxfirIdhit        = 0;
  localparam int          RxfirIdhitW       = 9;

  // RXIMR: Receive mask of buffer n, or of FIFO filter word n
  localparam logic [10:0] RximrAddr         = 11'h220;
  localparam int          RximrMi           = 0;
  localparam int          RximrMiW          = 32;

  // XID: Extension: identification
  localparam logic [10:0] XidAddr           = 11'h400;
  localparam logic [31:0] XidReset          = 32'h5643_414E;
  localparam int          XidXid            = 0;
  localparam int          XidXidW           = 32;

  // XVERSION: Extension: version of the extension page
  localparam logic [10:0] XversionAddr      = 11'h401;
  localparam logic [31:0] XversionReset     = 32'h0001_0003;
  localparam int          XversionMajor     = 16;
  localparam int          XversionMajorW    = 16;
  localparam int          XversionMinor     = 0;
  localparam int          XversionMinorW    = 16;

  // XCONFIG: Extension: what this core has
  localparam logic [10:0] XconfigAddr       = 11'h402;
  localparam logic [31:0] XconfigReset      = 32'h03F0_0F00;
  localparam int          XconfigClearram   = 25;
  localparam int          XconfigExtras     = 24;
  localparam int          XconfigWake       = 23;
  localparam int          XconfigStatus     = 22;
  localparam int          XconfigOwnmasks   = 21;
  localparam int          XconfigAbort      = 20;
  localparam int          XconfigTimesync   = 13;
  localparam int          XconfigTime       = 12;
  localparam int          XconfigRxfifo     = 11;
  localparam int          XconfigOsmb       = 10;
  localparam int          XconfigOneshot    = 9;
  localparam int          XconfigFdtol      = 8;
  localparam int          XconfigNumMb      = 0;
  localparam int          XconfigNumMbW     = 8;

  // XCTRL: Extension: control
  localparam logic [10:0] XctrlAddr         = 11'h403;
  localparam logic [31:0] XctrlReset        = 32'h0000_0000;
  localparam logic [31:0] XctrlAny          = 32'h0000_0006;
  localparam logic [31:0] XctrlFreeze       = 32'h0000_0001;
  localparam int          XctrlOsmb         = 2;
  localparam int          XctrlOneshot      = 1;
  localparam int          XctrlFdtol        = 0;

  // TCAP: Time: latencies of the stamps, in half clocks
  localparam logic [10:0] TcapAddr          = 11'h440;
  localparam logic [31:0] TcapReset         = 32'h0002_0003;
  localparam int          TcapSplat         = 16;
  localparam int          TcapSplatW        = 8;
  localparam int          TcapTxlat         = 8;
  localparam int          TcapTxlatW        = 8;
  localparam int          TcapRxlat         = 0;
  localparam int          TcapRxlatW        = 8;

  // TCTRL: Time: control
  localparam logic [10:0] TctrlAddr         = 11'h441;
  localparam logic [31:0] TctrlReset        = 32'h0000_0031;
  localparam logic [31:0] TctrlAny          = 32'h001F_3337;
  localparam int          TctrlSyncie       = 20;
  localparam int          TctrlTxie         = 19;
  localparam int          TctrlSlewie       = 18;
  localparam int          TctrlCmpie        = 17;
  localparam int          TctrlExtie        = 16;
  localparam int          TctrlCmpen        = 13;
  localparam int          TctrlOuten        = 12;
  localparam int          TctrlExtf         = 9;
  localparam int          TctrlExtr         = 8;
  localparam int          TctrlSlewr        = 4;
  localparam int          TctrlSlewrW       = 2;
  localparam int          TctrlTxpin        = 2;
  localparam int          TctrlPoint        = 0;
  localparam int          TctrlPointW       = 2;
  localparam logic [1:0]  TctrlPointSof     = 2'h0;
  localparam logic [1:0]  TctrlPointEdge    = 2'h1;
  localparam logic [1:0]  TctrlPointEof     = 2'h2;

  // TSTAT: Time: status
  localparam logic [10:0] TstatAddr         = 11'h442;
  localparam logic [31:0] TstatReset        = 32'h0000_0000;
  localparam int          TstatCmpon        = 19;
  localparam int          TstatOut          = 18;
  localparam int          TstatHeld         = 17;
  localparam int          TstatSlewing      = 16;
  localparam int          TstatSync         = 5;
  localparam int          TstatTxrel        = 4;
  localparam int          TstatSlewd        = 3;
  localparam int          TstatCmp          = 2;
  localparam int          TstatExtovr       = 1;
  localparam int          TstatExt          = 0;

  // TIMELO: Time: clock, lower half
  localparam logic [10:0] TimeloAddr        = 11'h444;
  localparam logic [31:0] TimeloReset       = 32'h0000_0000;
  localparam logic [31:0] TimeloAny         = 32'hFFFF_FFFF;
  localparam int          TimeloTimelo      = 0;
  localparam int          TimeloTimeloW     = 32;

  // TIMEHI: Time: clock, upper half
  localparam logic [10:0] TimehiAddr        = 11'h445;
  localparam logic [31:0] TimehiReset       = 32'h0000_0000;
  localparam logic [31:0] TimehiAny         = 32'hFFFF_FFFF;
  localparam int          TimehiTimehi      = 0;
  localparam int          TimehiTimehiW     = 32;

  // TINCN: Time: increment, whole ns
  localparam logic [10:0] TincnAddr         = 11'h446;
  localparam logic [31:0] TincnReset        = 32'h0000_0000;
  localparam int          TincnTincn        = 0;
  localparam int          TincnTincnW       = 8;

  // TINCF: Time: increment, fraction
  localparam logic [10:0] TincfAddr         = 11'h447;
  localparam logic [31:0] TincfReset        = 32'h0000_0000;
  localparam int          TincfTincf        = 0;
  localparam int          TincfTincfW       = 32;

  // TSHLO: Time: offset, lower half
  localparam logic [10:0] TshloAddr         = 11'h448;
  localparam logic [31:0] TshloReset        = 32'h0000_0000;
  localparam int          TshloTshlo        = 0;
  localparam int          TshloTshloW       = 32;

  // TSHHI: Time: offset, upper half
  localparam logic [10:0] TshhiAddr         = 11'h449;
  localparam logic [31:0] TshhiReset        = 32'h0000_0000;
  localparam int          TshhiTshhi        = 0;
  localparam int          TshhiTshhiW       = 32;

  // TSLEW: Time: offset that is worked off
  localparam logic [10:0] TslewAddr         = 11'h44A;
  localparam logic [31:0] TslewReset        = 32'h0000_0000;
  localparam logic [31:0] TslewAny          = 32'hFFFF_FFFF;
  localparam int          TslewTslew        = 0;
  localparam int          TslewTslewW       = 32;

  // TCMP: Time: next event
  localparam logic [10:0] TcmpAddr          = 11'h44C;
  localparam logic [31:0] TcmpReset         = 32'h0000_0000;
  localparam int          TcmpTcmp          = 0;
  localparam int          TcmpTcmpW         = 32;

  // TCMPH: Time: period of events
  localparam logic [10:0] TcmphAddr         = 11'h44D;
  localparam logic [31:0] TcmphReset        = 32'h0000_0000;
  localparam int          TcmphTcmph        = 0;
  localparam int          TcmphTcmphW       = 31;

  // TTX: Time: launch time
  localparam logic [10:0] TtxAddr           = 11'h450;
  localparam logic [31:0] TtxReset          = 32'h0000_0000;
  localparam int          TtxTtx            = 0;
  localparam int          TtxTtxW           = 32;

  // TTXMB: Time: buffer with a launch time
  localparam logic [10:0] TtxmbAddr         = 11'h451;
  localparam logic [31:0] TtxmbReset        = 32'h0000_0000;
  localparam logic [31:0] TtxmbAny          = 32'h8000_003F;
  localparam int          TtxmbHold         = 31;
  localparam int          TtxmbMb           = 0;
  localparam int          TtxmbMbW          = 6;

  // TEXTLO: Time: external event, lower half
  localparam logic [10:0] TextloAddr        = 11'h454;
  localparam logic [31:0] TextloReset       = 32'h0000_0000;
  localparam int          TextloTextlo      = 0;
  localparam int          TextloTextloW     = 32;

  // TEXTHI: Time: external event, upper half
  localparam logic [10:0] TexthiAddr        = 11'h455;
  localparam logic [31:0] TexthiReset       = 32'h0000_0000;
  localparam int          TexthiTexthi      = 0;
  localparam int          TexthiTexthiW     = 32;

  // TSCTRL: Follower: control
  localparam logic [10:0] TsctrlAddr        = 11'h460;
  localparam logic [31:0] TsctrlReset       = 32'h0000_0000;
  localparam logic [31:0] TsctrlAny         = 32'h3F7F_03F1;
  localparam int          TsctrlTmo         = 24;
  localparam int          TsctrlTmoW        = 6;
  localparam int          TsctrlKd          = 21;
  localparam int          TsctrlKdW         = 2;
  localparam int          TsctrlKi          = 16;
  localparam int          TsctrlKiW         = 5;
  localparam int          TsctrlPps         = 9;
  localparam int          TsctrlPhalf       = 8;
  localparam int          TsctrlDomain      = 4;
  localparam int          TsctrlDomainW     = 4;
  localparam int          TsctrlEn          = 0;

  // TSID: Follower: identifier of SYNC and FUP
  localparam logic [10:0] TsidAddr          = 11'h461;
  localparam logic [31:0] TsidReset         = 32'h0000_0000;
  localparam logic [31:0] TsidAny           = 32'h9FFF_FFFF;
  localparam int          TsidIde           = 31;
  localparam int          TsidId            = 0;
  localparam int          TsidIdW           = 29;

  // TSDLY: Follower: delay
  localparam logic [10:0] TsdlyAddr         = 11'h462;
  localparam logic [31:0] TsdlyReset        = 32'h0000_0000;
  localparam logic [31:0] TsdlyAny          = 32'h00FF_FFFF;
  localparam int          TsdlyTsdly        = 0;
  localparam int          TsdlyTsdlyW       = 24;

  // TSSTAT: Follower: status
  localparam logic [10:0] TsstatAddr        = 11'h463;
  localparam logic [31:0] TsstatReset       = 32'h0000_0000;
  localparam int          TsstatPairs       = 8;
  localparam int          TsstatPairsW      = 8;
  localparam int          TsstatSc          = 4;
  localparam int          TsstatScW         = 4;
  localparam int          TsstatState       = 0;
  localparam int          TsstatStateW      = 2;
  localparam logic [1:0]  TsstatStateUnsynchronised = 2'h0;
  localparam logic [1:0]  TsstatStateAcquiring = 2'h1;
  localparam logic [1:0]  TsstatStateLocked = 2'h2;
  localparam logic [1:0]  TsstatStateHoldover = 2'h3;

  // TSOFS: Follower: last offset
  localparam logic [10:0] TsofsAddr         = 11'h464;
  localparam logic [31:0] TsofsReset        = 32'h0000_0000;
  localparam int          TsofsTsofs        = 0;
  localparam int          TsofsTsofsW       = 32;

  // STAMPLO: Time: stamp of buffer n, lower half
  localparam logic [10:0] StamploAddr       = 11'h500;
  localparam int          StamploStamplo    = 0;
  localparam int          StamploStamploW   = 32;

  // STAMPHI: Time: stamp of buffer n, upper half
  localparam logic [10:0] StamphiAddr       = 11'h501;
  localparam int          StamphiStamphi    = 0;
  localparam int          StamphiStamphiW   = 32;

  // MB: Message buffer n
  localparam logic [10:0] MbAddr            = 11'h020;
  localparam int          MbCsOs            = 28;
  localparam int          MbCsCode          = 24;
  localparam int          MbCsCodeW         = 4;
  localparam logic [3:0]  MbCsCodeRxInactive = 4'h0;
  localparam logic [3:0]  MbCsCodeRxFull    = 4'h2;
  localparam logic [3:0]  MbCsCodeRxEmpty   = 4'h4;
  localparam logic [3:0]  MbCsCodeRxOverrun = 4'h6;
  localparam logic [3:0]  MbCsCodeTxInactive = 4'h8;
  localparam logic [3:0]  MbCsCodeTxAbort   = 4'h9;
  localparam logic [3:0]  MbCsCodeTxAnswer  = 4'hA;
  localparam logic [3:0]  MbCsCodeTxData    = 4'hC;
  localparam logic [3:0]  MbCsCodeTxAnswering = 4'hE;
  localparam int          MbCsSrr           = 22;
  localparam int          MbCsIde           = 21;
  localparam int          MbCsRtr           = 20;
  localparam int          MbCsDlc           = 16;
  localparam int          MbCsDlcW          = 4;
  localparam int          MbCsTimeStamp     = 0;
  localparam int          MbCsTimeStampW    = 16;
  localparam int          MbIdPrio          = 29;
  localparam int          MbIdPrioW         = 3;
  localparam int          MbIdExt           = 0;
  localparam int          MbIdExtW          = 29;
  localparam int          MbIdStd           = 18;
  localparam int          MbIdStdW          = 11;
  localparam int          MbData0Byte0      = 24;
  localparam int          MbData0Byte0W     = 8;
  localparam int          MbData0Byte1      = 16;
  localparam int          MbData0Byte1W     = 8;
  localparam int          MbData0Byte2      = 8;
  localparam int          MbData0Byte2W     = 8;
  localparam int          MbData0Byte3      = 0;
  localparam int          MbData0Byte3W     = 8;
  localparam int          MbData1Byte0      = 24;
  localparam int          MbData1Byte0W     = 8;
  localparam int          MbData1Byte1      = 16;
  localparam int          MbData1Byte1W     = 8;
  localparam int          MbData1Byte2      = 8;
  localparam int          MbData1Byte2W     = 8;
  localparam int          MbData1Byte3      = 0;
  localparam int          MbData1Byte3W     = 8;

  function automatic logic [31:0] mcr_has(input logic [31:0] xconfig);
    mcr_has = 32'hDBB6_CC80;
    if (xconfig[XconfigRxfifo]) mcr_has |= 32'h2000_0300;
    if (xconfig[XconfigAbort]) mcr_has |= 32'h0000_1000;
    if (xconfig[XconfigOwnmasks]) mcr_has |= 32'h0001_0000;
    if (xconfig[XconfigWake]) mcr_has |= 32'h0448_0000;
    if (xconfig[XconfigExtras]) mcr_has |= 32'h0000_207F;
  endfunction
  function automatic logic [31:0] mcr_without(input logic [31:0] xconfig);
    mcr_without = '0;
    if (!xconfig[XconfigExtras]) mcr_without |= (xconfig & 32'h0000_00FF) - 32'd1;
  endfunction

  function automatic logic [31:0] ctrl1_has(input logic [31:0] xconfig);
    ctrl1_has = 32'hFFFF_FFCF;
    if (xconfig[XconfigExtras]) ctrl1_has |= 32'h0000_0030;
  endfunction

  function automatic logic [31:0] ctrl2_has(input logic [31:0] xconfig);
    ctrl2_has = 32'hF0F9_FFFF;
    if (xconfig[XconfigRxfifo]) ctrl2_has |= 32'h0F04_0000;
    if (xconfig[XconfigExtras]) ctrl2_has |= 32'h0002_0000;
  endfunction
  function automatic logic [31:0] ctrl2_without(input logic [31:0] xconfig);
    ctrl2_without = '0;
    if (!xconfig[XconfigExtras]) ctrl2_without |= 32'h0002_0000;
  endfunction

  function automatic logic [31:0] xctrl_has(input logic [31:0] xconfig);
    xctrl_has = 32'hFFFF_FFF8;
    if (xconfig[XconfigExtras]) xctrl_has |= 32'h0000_0007;
  endfunction
endpackage
