/* SPDX-License-Identifier: GPL-2.0 */
/*
 * SPDX-FileCopyrightText: 2026 The VeriCAN authors
 *
 * ptp_verican: registers of the time unit and what the driver's two halves share.
 */
#ifndef PTP_VERICAN_H
#define PTP_VERICAN_H

#include <linux/bits.h>
#include <linux/interrupt.h>
#include <linux/io.h>
#include <linux/ptp_clock_kernel.h>
#include <linux/spinlock.h>
#include <linux/time64.h>

/* Offsets in the extension page. */
#define XID 0x000
#define XCONFIG 0x008
#define TCAP 0x100
#define TCTRL 0x104
#define TSTAT 0x108
#define TIMELO 0x110
#define TIMEHI 0x114
#define TINCN 0x118
#define TINCF 0x11c
#define TSHLO 0x120
#define TSHHI 0x124
#define TSLEW 0x128
#define TCMP 0x130
#define TCMPH 0x134
#define TEXTLO 0x150
#define TEXTHI 0x154

#define XID_VCAN 0x5643414e
#define XCONFIG_TIME BIT(12)
#define TCAP_RXLAT GENMASK(7, 0) /* half clocks */
#define TCTRL_EXTR BIT(8)
#define TCTRL_EXTF BIT(9)
#define TCTRL_OUTEN BIT(12)
#define TCTRL_CMPEN BIT(13)
#define TCTRL_EXTIE BIT(16)
#define TCTRL_CMPIE BIT(17)
#define TCTRL_IE GENMASK(20, 16)
#define TCTRL_EXT (TCTRL_EXTR | TCTRL_EXTF | TCTRL_EXTIE)
#define TCTRL_CMP (TCTRL_OUTEN | TCTRL_CMPEN | TCTRL_CMPIE)
#define TSTAT_EXT BIT(0)
#define TSTAT_EXTOVR BIT(1)
#define TSTAT_CMP BIT(2)
#define TSTAT_FLAGS GENMASK(5, 0)
#define TSTAT_OUT BIT(18)

struct verican_ptp {
	void __iomem *base;
	int irq; /* of the events; 0 or negative: none */
	struct ptp_clock *clock;
	struct ptp_clock_info info;
	/* Pairs of registers share one holding register; also TCTRL and what follows. */
	spinlock_t lock;
	u64 increment; /* ns a clock at the nominal rate, 16.48 bits */
	u32 ext_latency; /* ns from an edge at the pin to its time stamp */
	bool out; /* periodic output wanted */
	bool pps; /* pulses wanted */
	u64 first; /* ns: a time at which the output rises; not before that */
	u32 half; /* ns between two edges of the output */
};

static inline u32 verican_read(struct verican_ptp *vp, unsigned int offset)
{
	return readl(vp->base + offset);
}

static inline void verican_write(struct verican_ptp *vp, unsigned int offset, u32 value)
{
	writel(value, vp->base + offset);
}

/* The first word waits in the core until the second is there. */
static inline void verican_write_pair(struct verican_ptp *vp, unsigned int offset, u32 first,
				      u32 second)
{
	int clocks;

	verican_write(vp, offset, first);
	verican_write(vp, offset + 4, second);
	/* It acts four clocks later, and whoever looks at the time then must see it. */
	for (clocks = 0; clocks < 4; clocks++)
		verican_read(vp, TSTAT);
}

static inline void verican_change_ctrl(struct verican_ptp *vp, u32 clear, u32 set)
{
	verican_write(vp, TCTRL, (verican_read(vp, TCTRL) & ~clear) | set);
}

/* The lower half takes all 64 bits of one clock. */
static inline u64 verican_now(struct verican_ptp *vp, struct ptp_system_timestamp *sts)
{
	u32 low;

	ptp_read_system_prets(sts);
	low = verican_read(vp, TIMELO);
	ptp_read_system_postts(sts);
	return (u64)verican_read(vp, TIMEHI) << 32 | low;
}

/* ptp_verican_events.c */
int verican_enable(struct ptp_clock_info *info, struct ptp_clock_request *request, int on);
long verican_do_aux_work(struct ptp_clock_info *info);
void verican_rearm(struct verican_ptp *vp);
irqreturn_t verican_irq(int irq, void *data);

#endif
