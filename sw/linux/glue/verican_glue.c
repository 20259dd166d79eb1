// SPDX-License-Identifier: GPL-2.0
/*
 * SPDX-FileCopyrightText: 2026 The VeriCAN authors
 *
 * verican_glue: lets the device drivers of a user-mode Linux reach simulated CAN controllers. It
 * links into the test kernel alone and is the only kernel code that knows of a simulator.
 *
 * Three things, all over UNIX sockets and all in simulated time (time-travel=ext:...):
 *  - a register window: each access is one request and one blocking answer;
 *  - an interrupt controller of level-triggered lines. The answer to each access tells the level of
 *    the lines; a line that rises while this kernel waits is told on a socket of its own;
 *  - the attribute "command": a line of text for the simulator, and its answer.
 * The messages are described in sim/linux/guest_link.hpp.
 */
#include <linux/init.h>
#include <linux/interrupt.h>
#include <linux/irq.h>
#include <linux/irqdomain.h>
#include <linux/logic_iomem.h>
#include <linux/module.h>
#include <linux/of.h>
#include <linux/platform_device.h>
#include <linux/reboot.h>
#include <linux/time-internal.h>
#include <irq_kern.h>
#include <os.h>

#define GLUE_LINES 32

enum glue_op { GLUE_READ, GLUE_WRITE, GLUE_COMMAND };

struct glue_request {
	u32 op;
	u32 address;
	u32 value;
	u32 size; /* bytes of the access, or of the text that follows */
};

struct glue_answer {
	u32 value; /* what was read, or the length of the text that follows */
	u32 level; /* bit n: line n is high */
};

struct glue {
	struct platform_device *pdev;
	struct resource window;
	struct irq_domain *domain;
	struct time_travel_event event;
	int registers; /* socket of accesses and commands */
	int interrupts; /* socket of lines that rise while the kernel waits */
	int irq;
	u32 level;
	u32 enabled;
	bool broken;
	char reply[PAGE_SIZE];
};

/* logic_iomem hands no context to map(); there is one simulator for a kernel. */
static struct glue *the_glue;

static char *sockets;
module_param(sockets, charp, 0444);
MODULE_PARM_DESC(sockets, "directory of the simulator's sockets");

/* ---- Sockets */

static int glue_read(int fd, void *buf, int len)
{
	while (len > 0) {
		int rc = os_read_file(fd, buf, len);

		if (rc == -EINTR)
			continue;
		if (rc <= 0)
			return rc < 0 ? rc : -ECONNRESET;
		buf += rc;
		len -= rc;
	}
	return 0;
}

static int glue_write(int fd, const void *buf, int len)
{
	while (len > 0) {
		int rc = os_write_file(fd, buf, len);

		if (rc == -EINTR)
			continue;
		if (rc <= 0)
			return rc < 0 ? rc : -ECONNRESET;
		buf += rc;
		len -= rc;
	}
	return 0;
}

/* A simulator that is gone leaves nothing to test: the guest stops. */
static void glue_lost(struct glue *glue, int error)
{
	if (glue->broken)
		return;
	glue->broken = true;
	dev_err(&glue->pdev->dev, "the simulator is gone (%d)\n", error);
	orderly_poweroff(true);
}

/* ---- Interrupts */

/* The event runs when this kernel waits for time to pass or enables its interrupts. */
static void glue_raise(struct glue *glue)
{
	if (glue->level & glue->enabled)
		time_travel_add_irq_event(&glue->event);
}

static void glue_dispatch(struct glue *glue)
{
	unsigned int line;

	for (line = 0; line < GLUE_LINES; line++)
		if (glue->level & glue->enabled & BIT(line))
			generic_handle_domain_irq(glue->domain, line);
}

static void glue_event(struct time_travel_event *event)
{
	glue_dispatch(container_of(event, struct glue, event));
}

static irqreturn_t glue_irq(int irq, void *data)
{
	glue_dispatch(data);
	return IRQ_HANDLED;
}

/* A line has risen while the kernel waits: called from the signal, before the simulator goes on. */
static void glue_line_rose(int irq, int fd, void *data, struct time_travel_event *event)
{
	struct glue *glue = data;
	u32 level;
	int rc = os_read_file(fd, &level, sizeof(level));

	if (rc == -EAGAIN || rc == -EINTR)
		return;
	if (rc != sizeof(level)) {
		glue->broken = true;
		return;
	}
	glue->level = level;
	if (glue->level & glue->enabled)
		time_travel_add_irq_event(event);
	glue_write(fd, &level, sizeof(level));
}

static void glue_mask(struct irq_data *data)
{
	struct glue *glue = irq_data_get_irq_chip_data(data);

	glue->enabled &= ~BIT(irqd_to_hwirq(data));
}

/* The lines are level-triggered: one that is still high interrupts again. */
static void glue_unmask(struct irq_data *data)
{
	struct glue *glue = irq_data_get_irq_chip_data(data);

	glue->enabled |= BIT(irqd_to_hwirq(data));
	glue_raise(glue);
}

static struct irq_chip glue_chip = {
	.name = "verican",
	.irq_mask = glue_mask,
	.irq_unmask = glue_unmask,
};

static int glue_map_line(struct irq_domain *domain, unsigned int irq, irq_hw_number_t line)
{
	irq_set_chip_data(irq, domain->host_data);
	irq_set_chip_and_handler(irq, &glue_chip, handle_level_irq);
	return 0;
}

static const struct irq_domain_ops glue_domain_ops = {
	.map = glue_map_line,
	.xlate = irq_domain_xlate_onecell,
};

/* ---- Accesses */

static int glue_exchange(struct glue *glue, const struct glue_request *request, const void *text,
			 struct glue_answer *answer)
{
	unsigned long flags;
	int rc;

	if (glue->broken)
		return -ENODEV;
	local_irq_save(flags);
	rc = glue_write(glue->registers, request, sizeof(*request));
	if (!rc && text)
		rc = glue_write(glue->registers, text, request->size);
	if (!rc)
		rc = glue_read(glue->registers, answer, sizeof(*answer));
	if (!rc && request->op == GLUE_COMMAND) {
		u32 len = min_t(u32, answer->value, sizeof(glue->reply) - 1);

		rc = glue_read(glue->registers, glue->reply, len);
		glue->reply[len] = 0;
	}
	if (!rc) {
		glue->level = answer->level;
		glue_raise(glue);
	}
	local_irq_restore(flags);
	if (rc)
		glue_lost(glue, rc);
	return rc;
}

static unsigned long glue_window_read(void *priv, unsigned int offset, int size)
{
	struct glue_request request = { GLUE_READ, offset, 0, size };
	struct glue_answer answer;

	return glue_exchange(priv, &request, NULL, &answer) ? ~0UL : answer.value;
}

static void glue_window_write(void *priv, unsigned int offset, int size, unsigned long value)
{
	struct glue_request request = { GLUE_WRITE, offset, value, size };
	struct glue_answer answer;

	glue_exchange(priv, &request, NULL, &answer);
}

static const struct logic_iomem_ops glue_window_ops = {
	.read = glue_window_read,
	.write = glue_window_write,
};

static long glue_window_map(unsigned long offset, size_t size, const struct logic_iomem_ops **ops,
			    void **priv)
{
	*ops = &glue_window_ops;
	*priv = the_glue;
	return offset;
}

static const struct logic_iomem_region_ops glue_region_ops = {
	.map = glue_window_map,
};

/* ---- Commands */

static ssize_t command_store(struct device *dev, struct device_attribute *attr, const char *buf,
			     size_t count)
{
	struct glue *glue = dev_get_drvdata(dev);
	struct glue_request request = { GLUE_COMMAND, 0, 0, count };
	struct glue_answer answer;
	int rc = glue_exchange(glue, &request, buf, &answer);

	if (rc)
		return rc;
	return strncmp(glue->reply, "error:", 6) ? count : -EINVAL;
}

static ssize_t command_show(struct device *dev, struct device_attribute *attr, char *buf)
{
	struct glue *glue = dev_get_drvdata(dev);

	return sysfs_emit(buf, "%s", glue->reply);
}
static DEVICE_ATTR_RW(command);

static struct attribute *glue_attrs[] = { &dev_attr_command.attr, NULL };
ATTRIBUTE_GROUPS(glue);

/* ---- Set-up */

static int glue_connect(struct device *dev, const char *name)
{
	char *path = kasprintf(GFP_KERNEL, "%s/%s", sockets, name);
	int fd;

	if (!path)
		return -ENOMEM;
	fd = os_connect_socket(path);
	if (fd < 0)
		dev_err(dev, "no simulator at %s (%d)\n", path, fd);
	kfree(path);
	return fd;
}

static int glue_probe(struct platform_device *pdev)
{
	struct device *dev = &pdev->dev;
	struct resource *reg = platform_get_resource(pdev, IORESOURCE_MEM, 0);
	struct glue *glue;
	int rc;

	if (!um_irq_timetravel_handler_used() || !sockets || !reg || the_glue)
		return dev_err_probe(dev, -EINVAL, "needs time-travel=ext:, sockets= and reg\n");
	glue = devm_kzalloc(dev, sizeof(*glue), GFP_KERNEL);
	if (!glue)
		return -ENOMEM;
	glue->pdev = pdev;
	glue->window =
		(struct resource)DEFINE_RES_MEM_NAMED(reg->start, resource_size(reg), "verican");
	time_travel_set_event_fn(&glue->event, glue_event);
	platform_set_drvdata(pdev, glue);
	the_glue = glue;

	glue->registers = glue_connect(dev, "registers");
	if (glue->registers < 0)
		return glue->registers;
	glue->interrupts = glue_connect(dev, "interrupts");
	if (glue->interrupts < 0)
		return glue->interrupts;
	glue->domain = irq_domain_add_linear(dev->of_node, GLUE_LINES, &glue_domain_ops, glue);
	if (!glue->domain)
		return -ENOMEM;
	rc = um_request_irq_tt(UM_IRQ_ALLOC, glue->interrupts, IRQ_READ, glue_irq, 0, "verican",
			       glue, glue_line_rose);
	if (rc < 0)
		return rc;
	glue->irq = rc;
	return logic_iomem_add_region(&glue->window, &glue_region_ops);
}

static const struct of_device_id glue_of_match[] = {
	{ .compatible = "verican,uml-glue" },
	{},
};

/* Regions of logic_iomem cannot be removed, so neither can this module: there is no exit. */
static struct platform_driver glue_driver = {
	.probe = glue_probe,
	.driver = {
		.name = "verican_glue",
		.of_match_table = glue_of_match,
		.dev_groups = glue_groups,
		.suppress_bind_attrs = true,
	},
};
builtin_platform_driver(glue_driver);

MODULE_DESCRIPTION("Registers and interrupts of simulated CAN controllers for user-mode Linux");
MODULE_LICENSE("GPL");
