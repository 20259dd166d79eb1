# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Reading nodes of can_remote, and who is there; verican_remote.py is what to import."""
import contextlib

from verican_remote_link import (ALL, IDENT, ROW_IDENT, ROW_STATUS, STATEMENT, STATUS, Answer,
                                 Identity, InUse, Link, NotTaken, Refused, Status, Timeout, TooMany)

SERIAL = ROW_IDENT + 4  # address of the serial number


@contextlib.contextmanager
def refused_at(number, address):
    """A refusal in here is that of a part of an access that begins at `address`."""
    try:
        yield
    except Refused as refused:
        raise Refused(refused.code, number, address) from None


class Nodes(Link):
    """Calls that read, and those that find nodes and give them numbers."""

    def read(self, number, address, length):
        """Bytes of a node; what does not fit a frame is read in parts."""
        self.require_node(number)
        self.require_range(address, length)
        data = b""
        while len(data) < length:
            at = address + len(data)
            _, request, answer = self.read_request(number, at, length - len(data))
            with refused_at(number, at):
                data += self.ask(number, answer, *request)
        return data

    def _row(self, number, port, address):
        self.require_node(number)
        if not self.remote_frames:
            return self.read(number, address, 8)
        identifier = self.port(number, port)
        return self.ask(number, Answer(identifier | STATEMENT, 8), identifier, b"", 8)

    def status(self, number):
        """Status of a node."""
        row = self._row(number, STATUS, ROW_STATUS)
        self._refusals[number] = row[6]
        return Status.of(row)

    def identity(self, number):
        """Identity of a node."""
        return Identity.of(number, self._row(number, IDENT, ROW_IDENT))

    def poll(self, address, length, expected=()):
        """{number: bytes} of all nodes at one moment, at most 8 bytes (6 beyond the window or
        without remote frames). Ends when the numbers of `expected` have answered; without, after
        the time-out."""
        expected = set(expected)  # once: of an iterator nothing is left
        found = self.gather(address, length, expected)
        if not expected <= found.keys():
            raise Timeout(f"no answer of {sorted(expected - found.keys())}")
        return {number: answers[-1] for number, answers in sorted(found.items())}

    def gather(self, address, length, expected):
        """As poll(), but {number: [bytes, ...]}, without a Timeout: different answers under one
        number are those of different nodes, which share it (RN-11)."""
        self.require_range(address, length)
        for number in expected:
            self.require_node(number)
        fits, request, answer = self.read_request(ALL, address, length)
        if fits != length:
            raise ValueError(f"{length} bytes from 0x{address:X} are more than one frame")
        self.flush()
        self.send(*request)
        found = {}
        for message in self.frames(self.timeout):
            number = (message.arbitration_id & 0x3FF) >> (10 - self.name_bits)
            its = Answer(answer.id | self.id(number, 0), answer.dlc, answer.head)
            if number < 2 or not its.fits(message):  # 0 and 1 are no node's
                self.pass_on(message)
            elif its.bytes_of(message) not in found.setdefault(number, []):
                found[number].append(its.bytes_of(message))
            if expected and expected <= found.keys():
                break
        return found

    def select(self, value, mask=0xFFFFFFFF, only_new=False, witness=None):
        """Selects the nodes whose serial number equals `value` under `mask` (`only_new`: of those
        without a number); whether there is one. `witness` is the number of a node that answers:
        then nothing depends on how long HERE takes, which is select_wait at most otherwise."""
        self.require_serial(value)
        self.require_serial(mask)
        pairs = zip(value.to_bytes(4, "little"), mask.to_bytes(4, "little"))
        self.flush()
        self.here = False
        function = 4 if only_new else 2
        self.send(self.id(0, function), bytes(byte for pair in pairs for byte in pair))
        if witness:
            self._wait_for_witness(witness)
        else:
            self._wait_for_here()
        return self.here

    def _wait_for_here(self):
        for message in self.frames(self.select_wait):
            self.pass_on(message)
            if self.here:
                break

    def _wait_for_witness(self, witness):
        """Asks it twice. HERE wins arbitration against all other frames of nodes, so it comes
        before what answers a request behind SELECT; but a node that is error passive and has to
        repeat its HERE lets one frame pass. What the witness answers is the same to us."""
        _, request, answer = self.read_request(witness, ROW_IDENT, 1)
        for _ in range(2):
            with contextlib.suppress(Timeout, Refused):
                self.ask(witness, answer, *request)

    def scan(self, most=256):
        """All nodes: those with a number in its order, then those without by serial number. Nodes
        that share a number disturb each other's answers (RN-15); SELECT finds them (RN-26).
        TooMany: more than `most` answer, of whom nobody knows how many there would be: on a bus
        where every SELECT is answered, 2^32."""
        if isinstance(most, bool) or not isinstance(most, int) or most < 1:
            raise ValueError(f"most {most}: allowed are 1 and more")
        return Scan(self, most).nodes()

    def assign(self, serial, number):
        """Gives the node with this serial number a number (0: takes it away), and asks it whether
        it has taken it; NotTaken. InUse: another node has the number (RN-11)."""
        self.require_node(number, 0)
        self.require_serial(serial)
        if not self._find(serial):
            raise Timeout(f"no node with serial number {serial:08X}")
        if number and not self._is_free(number, serial):
            raise InUse(f"another node has number {number}")
        taken = self._give_number(number) if number else self._take_number(serial)
        if not taken:
            raise NotTaken(f"the node with serial number {serial:08X} is there, but does not take "
                           f"number {number}; in OPERATE it takes none")

    def _find(self, serial, only_new=False):
        return any(self.select(serial, only_new=only_new) for _ in range(self.tries))

    def _is_free(self, number, serial):
        """Whether no other node than that one has the number. Whoever has it answers a reading of
        what is the same in all nodes, or refuses it; asked once, for what is disturbed on the bus
        is repeated there."""
        _, request, answer = self.read_request(number, ROW_IDENT, 1)
        with contextlib.suppress(Refused):
            if self.ask_once(number, answer, *request) is None:
                return True
        return self.gather(SERIAL, 4, ()).get(number) == [serial.to_bytes(4, "little")]

    def _take_number(self, serial):
        """A node that has no number any more can only say that it is new."""
        self.send(self.id(0, 3), b"\0")
        return self._find(serial, only_new=True)

    def _give_number(self, number):
        """ASSIGN may come more than once (RN-27); the answer is STATUS of the new number."""
        self._refusals.pop(number, None)
        answer = Answer(self.port(number, STATUS) | STATEMENT, 8)
        with contextlib.suppress(Timeout):
            self.ask(number, answer, self.id(0, 3), bytes([number]))
            return True
        return False


class Scan:
    """A scan. Nodes that share a number answer at once: equal answers are one frame, different
    ones destroy each other. So a poll of bytes that are the same in all nodes tells which numbers
    there are, one of serial numbers tells those of nodes that are alone under their number, and
    SELECT, to which equal frames answer, finds whoever is left."""

    def __init__(self, client, most):
        self.client, self.most = client, most
        self.numbers = set(client.poll(ROW_IDENT, 1))
        told = client.gather(SERIAL, 4, self.numbers) if self.numbers else {}
        self.serials = {number: int.from_bytes(answers[0], "little")
                        for number, answers in told.items()}
        self.witness = min(self.serials or self.numbers, default=None)

    def nodes(self):
        """What Nodes.scan() gives."""
        new = list(self._walk(True, []))
        shared = []
        if self.numbers:
            known = set(self.serials.values()) | set(new)
            shared = [serial for serial in self._walk(False, known) if serial not in known]
        number = self._shared_number() if shared else None
        nodes = [Identity(*pair) for pair in self.serials.items()]
        nodes += [Identity(number, serial) for serial in shared]
        nodes = [self._asked(node, nodes) for node in nodes]
        last = 1 << self.client.name_bits
        nodes.sort(key=lambda node: (last if node.number is None else node.number, node.serial))
        return nodes + [Identity(0, serial) for serial in new]

    def _shared_number(self):
        """The number of the nodes that share one: that whose serial number does not come, or
        differs. None: of several nobody can tell which node has which."""
        shared = self.numbers - self.serials.keys()
        if not shared:
            told = self.client.gather(SERIAL, 4, ())
            shared = {number for number in self.numbers if len(told.get(number, ())) != 1}
        return shared.pop() if len(shared) == 1 else None

    def _asked(self, node, nodes):
        """The node with all that it says of itself, if it is alone under its number."""
        alone = sum(other.number == node.number for other in nodes) == 1
        node.doubled = not alone or node.number is None
        if not node.doubled:
            with contextlib.suppress(Timeout, Refused):
                identity = self.client.identity(node.number)
                return identity if identity.serial == node.serial else node
        return node

    def _walk(self, only_new, known):
        """Serial numbers that are there (`only_new`: of nodes without a number), in their order;
        for those that are `known` nobody is asked."""
        serial = found = 0
        while serial <= 0xFFFFFFFF:
            serial = self._next_serial(serial, only_new, known)
            if serial is None:
                return
            found += 1
            if found > self.most:
                raise TooMany(f"more than {self.most} nodes answer")
            yield serial
            serial += 1

    def _next_serial(self, value, only_new, known):
        """The smallest serial number from `value` on, or None. Walks down a tree of prefixes: 33
        SELECTs for a number."""
        bit = 31
        while True:
            mask = 0xFFFFFFFF << bit & 0xFFFFFFFF
            if (any((serial ^ value) & mask == 0 for serial in known)
                    or self.client.select(value, mask, only_new, self.witness)):
                if bit == 0:
                    return value
                bit -= 1
                continue
            while bit < 32 and value >> bit & 1:
                bit += 1
            if bit == 32:
                return None
            value = (value | 1 << bit) >> bit << bit
