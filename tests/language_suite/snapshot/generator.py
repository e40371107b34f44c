"""Makes random designs in the language of 2026: expressions, calls of modules, files that use each other."""

import random

# What a place wants: a number, a vector, a matrix, a string, a range, an object, a function, or anything.
# One place in ten gets anything.
NUMBER, VECTOR, MATRIX, STRING, RANGE, OBJECT, FUNCTION, ANY = "nvmsrofa"
COLUMN = "c"  # of a matrix: one that there is not crashes the snapshot's search()
POINTS = "p"  # of three numbers: of two that are none the snapshot shows what its memory holds

# No numbers below 1e-307, which the snapshot's library refuses.
NUMBERS = ["0", "1", "2", "3", "4", "5", "7", "-1", "-2", "-0", "0.5", "-0.5", "1.5", "2.5", "1/3", "30", "45", "90",
           "180", "270", "360", "359.9", "-400", "12.345678", "100", "1e3", "1e5", "123456.5", "1e6", "1234567", "1e10",
           "-1e10", "1e300", "1e-300", "1e-5", "1e-6", "1e-7", "1.0e308", ".5", "2.", "1/0", "-1/0", "0/0", "0x0",
           "0x1F", "0xff", "0xdeadBEEF", "0x7fffffffffffffff", "0xFFFFFFFFFFFFFFFF", "0x", "4294967296",
           "9007199254740993", "1e19", "63", "64", "65", "8364", "55296", "1114112"]
STRINGS = ["", "a", "b", "ab", "abc", "banana", "cab", "0", "1", "-1.5", "0x10", "é", "éa", "€uro", "𝄞x", "A",
           "true", "[1]", "x y", "red", "#f00", "#12345678", "#ggg", "DarkSlateGray", "x z", "\\n", "\\t", "\\r",
           "\\\"q\\\\", "\\x41", "\\u20ac", "\\U01f600", "undef", "a text of more than sixteen bytes", "straight",
           "voronoi", "ltr", "ttb", "center", "top", "data.json", "arab", "de", "שלום"]
BINARY = ["+", "-", "*", "/", "%", "^", "&", "|", "<<", ">>"]
COMPARISONS = ["<", "<=", ">", ">=", "==", "!=", "&&", "||"]
KEYS = ['"a"', '"k"', '"z z"', '"f"', '"x"', '"size"']
MEMBERS = {NUMBER: ["x", "y", "z", "w", "r", "g", "b", "a", "begin", "step", "end"],
           VECTOR: ["xy", "zyx", "rgba", "xxxx", "zw", "xyzwx", "xr", "foo"], OBJECT: ["o", "a", "k", "f", "size"]}

# Each function of the language: what it returns, and what it wants.
FUNCTIONS = [
    *[(name, NUMBER, NUMBER) for name in ("abs sign floor ceil round sqrt exp ln log sin cos tan asin acos "
                                          "atan").split()],
    ("log", NUMBER, "nn"), ("pow", NUMBER, "nn"), ("atan2", NUMBER, "nn"), ("min", NUMBER, "nnn"),
    ("max", NUMBER, "nn"), ("min", NUMBER, VECTOR), ("max", NUMBER, MATRIX), ("norm", NUMBER, VECTOR),
    ("len", NUMBER, VECTOR), ("len", NUMBER, STRING), ("ord", NUMBER, STRING), ("lookup", NUMBER, "nm"),
    ("version_num", NUMBER, ""), ("cross", VECTOR, "vv"),
    ("concat", VECTOR, "av"), ("concat", VECTOR, "vvm"), ("search", VECTOR, "av"), ("search", VECTOR, "ssn"),
    ("search", VECTOR, "smnc"), ("search", VECTOR, "vmnc"), ("search", VECTOR, "nmnc"), ("version", VECTOR, ""),
    ("str", STRING, "aaa"), ("str", STRING, NUMBER), ("chr", STRING, "nv"), ("chr", STRING, RANGE),
    ("parent_module", STRING, NUMBER), ("parent_module", STRING, ""),
    *[(f"is_{name}", ANY, ANY) for name in "list num bool string function undef object".split()],
    ("has_key", ANY, "os"), ("object", OBJECT, "oo"), ("object", OBJECT, MATRIX), ("import", OBJECT, STRING),
    ("g", ANY, "an"), ("h", ANY, "nn"), ("uf", ANY, "aa"), ("f", ANY, "aa"), ("$f", ANY, "aa"), ("nofunc", ANY, "n"),
    ("tail", NUMBER, "n"),
]
METRICS = ["text", "size", "direction", "language", "script", "halign", "valign", "spacing", "foo"]

ROUND = {"$fn": NUMBER, "$fa": NUMBER, "$fs": NUMBER}
MODULES = {
    "cube": {"size": "v", "center": "a"}, "sphere": {"r": "n", "d": "n", **ROUND},
    "cylinder": {"h": "n", "r1": "n", "r2": "n", "center": "a", "r": "n", "d": "n", "d1": "n", "d2": "n", **ROUND},
    "circle": {"r": "n", "d": "n", **ROUND}, "square": {"size": "v", "center": "a"},
    "polygon": {"points": "m", "paths": "m", "convexity": "n"},
    "polyhedron": {"points": "p", "faces": "m", "convexity": "n", "triangles": "m"},
    "text": {"text": "s", "size": "n", "font": "s", "direction": "s", "language": "s", "script": "s", "halign": "s",
             "valign": "s", "spacing": "n", **ROUND},
    "translate": {"v": "v"}, "rotate": {"a": "v", "v": "v"}, "scale": {"v": "v"}, "mirror": {"v": "v"},
    "multmatrix": {"m": "m"}, "color": {"c": "s", "alpha": "n"},
    "linear_extrude": {"height": "n", "v": "v", "scale": "v", "center": "a", "twist": "n", "slices": "n",
                       "segments": "n", "convexity": "n", "h": "n", **ROUND},
    "rotate_extrude": {"angle": "n", "start": "n", "convexity": "n", "a": "n", **ROUND},
    "projection": {"cut": "a", "convexity": "n"}, "offset": {"r": "n", "delta": "n", "chamfer": "a", **ROUND},
    "resize": {"newsize": "v", "auto": "v", "convexity": "n"}, "render": {"convexity": "n"},
    "minkowski": {"convexity": "n"}, "roof": {"method": "s", "convexity": "n", **ROUND},
    "surface": {"file": "s", "center": "a", "convexity": "n", "invert": "a"},
    "import": {"file": "s", "layer": "s", "convexity": "n", "origin": "v", "scale": "n", "width": "n", "height": "n",
               "filename": "s", "center": "a", "dpi": "n", "id": "s", **ROUND},
    "intersection_for": {"i": "r"}, "nomodule": {"a": "n"},
    "union": {}, "hull": {}, "fill": {}, "difference": {}, "intersection": {}, "group": {},
    "children": {"index": "n"}, "m": {"p": "a", "q": "n", "$g": "a"}, "n": {"p": "v"}, "um": {"p": "a", "q": "v"},
}
PIECES = ["\n", "\r\n", "\r", "// c\n", "/* x\r\n */", ";", "}", "{", "(", "]", ",", ",,", "else", "\"s\n\"", "\"",
          "/*", "$x=3;", "function", "module", "include", "use\r\n", "!", "%", "*", "\t", "let", "=", "0x", "~",
          "<<", "&&", "$", "each", "2d", "\xa0", "é", "@"]
# Each file, and those that it may name: none is named in two ways, which the snapshot takes for
# two files, and used by a file in a folder, whose messages about it have other paths.
FILES = {"a.scad": ["lib/b.scad", "lib/c.scad", "used.scad", "lib/\nb.scad"], "lib/b.scad": ["c.scad", "\nc.scad"],
         "lib/c.scad": []}
NAMED_BY_MAIN = ["a.scad", "lib/b.scad", "lib/c.scad", "used.scad", "lib\n/c.scad"]
MISSING = ["none.scad", "lib/none.scad", "lib", ""]


class Generator:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.is_aborting = False  # whether assertions may fail: what follows is not evaluated then

    def pick(self, options):
        return self.random.choice(options)

    def one_in(self, count):
        return self.random.randrange(count) == 0

    # Expressions

    def value(self, wanted=ANY, depth=4):
        if wanted == COLUMN:
            return self.pick("001")
        if wanted == POINTS:
            return self.matrix(depth - 1, 3)
        if self.one_in(10):
            wanted = ANY
        less = depth - 1
        if depth > 0 and not self.one_in(4):
            shared = [lambda: self.call(wanted, less), lambda: self.call(wanted, less),
                      lambda: f"({self.value(ANY, less)}?{self.value(wanted, less)}:{self.value(wanted, less)})",
                      lambda: f"{self.value(self.pick('vmso'), less)}[{self.value(self.pick('ns'), less)}]",
                      lambda: self.bound(wanted, less)]
            return self.pick(shared + self.makers(wanted, less))()
        return self.leaf(wanted)

    def leaf(self, wanted):
        if self.one_in(5):
            return self.pick(["a", "b", "v", "o", "o2", "f", "$g", "$h", "nothing", "2d", "$fn", "$t", "$preview",
                              "$children", "i", "p", "$parent_modules", "PI"])
        return {NUMBER: lambda: f"({self.pick(NUMBERS)})", STRING: lambda: f'"{self.pick(STRINGS)}"',
                VECTOR: lambda: self.list(NUMBER, 0), MATRIX: lambda: self.matrix(0), RANGE: lambda: self.range(0),
                OBJECT: lambda: self.pick(["o", "o2", "object()", "object(a=1)"]),
                FUNCTION: lambda: self.pick(["f", "$f", "function(x) x", "function(p,q=2) [p,q]"]),
                ANY: lambda: self.pick(["true", "false", "undef", self.leaf(self.pick("nvmsrof"))])}[wanted]()

    def makers(self, wanted, less):
        """What makes a value of a kind, by the syntax of that kind."""
        value = self.value
        if wanted == NUMBER:
            return [lambda: f"({self.pick('-~+')}{value(NUMBER, less)})",
                    *[lambda: f"({value(NUMBER, less)}{self.pick(BINARY)}{value(NUMBER, less)})"] * 3,
                    lambda: f"({value(VECTOR, less)}*{value(VECTOR, less)})",
                    lambda: f"{value(VECTOR, less)}.{self.pick(MEMBERS[NUMBER])}"]
        if wanted in (VECTOR, MATRIX):
            return [lambda: self.list(ANY if self.one_in(3) else NUMBER, less), lambda: self.matrix(less),
                    lambda: f"(-{value(wanted, less)})", lambda: self.comprehension(less),
                    lambda: self.comprehension(less),
                    lambda: f"({value(wanted, less)}{self.pick('+-*/')}{value(self.pick('nvm'), less)})",
                    lambda: f"{value(self.pick('vvo'), less)}.{self.pick(MEMBERS[VECTOR] + MEMBERS[OBJECT])}"]
        if wanted == STRING:
            return [lambda: f"str({value(ANY, less)})", lambda: f"{value(STRING, less)}[{value(NUMBER, less)}]"]
        if wanted == RANGE:
            return [lambda: self.range(less)]
        if wanted == OBJECT:
            return [lambda: self.object(less)] * 3
        if wanted == FUNCTION:
            return [lambda: f"(function({self.parameters(less)}) {value(ANY, less)})"]
        return [lambda: f"({value(ANY, less)}{self.pick(COMPARISONS + BINARY)}{value(ANY, less)})",
                lambda: f"(!{value(ANY, less)})",
                *[lambda kind=kind: f"({value(kind, less)}{self.pick(COMPARISONS)}{value(kind, less)})"
                  for kind in "nsv"],
                *[lambda kind=kind: value(kind, less) for kind in "nvmsrof"],
                lambda: f"{value(OBJECT, less)}.f({self.arguments({'p': ANY, 'q': ANY}, less)})",
                lambda: f'{value(OBJECT, less)}["f"]({self.arguments({"p": ANY, "x": ANY}, less)})']

    def list(self, wanted, depth):
        return "[" + ",".join(self.value(wanted, depth - 1) for _ in range(self.pick([0, 1, 2, 2, 3, 3, 4]))) + "]"

    def matrix(self, depth, columns=0):
        first = self.pick([NUMBER, NUMBER, NUMBER, STRING])
        columns = columns or self.pick([2, 2, 3, 4])
        rows = []
        for _ in range(self.pick([1, 2, 3, 3, 4])):
            wide = columns if not self.one_in(12) else self.pick([0, 1, 5])
            rows.append("[" + ",".join(self.value(first if at == 0 else NUMBER, depth - 1) for at in range(wide)) + "]")
        if self.one_in(15):
            rows.append(self.value(ANY, depth - 1))
        return "[" + ",".join(rows) + "]"

    def range(self, depth):
        parts = [self.value(NUMBER, depth - 1) if self.one_in(3) else self.pick(NUMBERS)
                 for _ in range(self.pick([2, 2, 3]))]
        return "[" + ":".join(parts) + "]"

    def rounds(self, depth):
        """What a loop runs over: a range of few, none or too many elements, a vector, a string, an object."""
        if self.one_in(2):
            parts = [self.pick(["0", "1", "-1", "a", "0.5", "3", "0/0"]), self.pick(["2", "3", "-2", "1/0", "b.x", "1e10"])]
            if self.one_in(2):
                parts.insert(1, self.pick(["1", "0.5", "2", "-1", "0", "0/0", "1/0", "(0-1)"]))
            return "[" + ":".join(parts) + "]"
        return self.value(self.pick("vmsoa"), depth)

    def comprehension(self, depth):
        def element(less):
            kind = self.random.random() if less > 0 else 0
            if kind < 0.4:
                return self.value(ANY, less)
            if kind < 0.5:
                return f"each {element(less - 1)}"
            if kind < 0.65:
                other = f" else {element(less - 1)}" if self.one_in(2) else ""
                return f"if({self.value(ANY, less)}) {'(' + element(less - 1) + ')' if other else element(less - 1)}{other}"
            if kind < 0.75:
                return f"let({self.bindings(less)}) {element(less - 1)}"
            if kind < 0.83:
                return f"for(i=0,a={self.value(ANY, less)};i<2;i=i+1{self.pick(['', ',a=i', ',$g=i'])}) {element(less - 1)}"
            return f"for({self.pick('iap')}={self.rounds(less)}{self.pick(['', '', ',b=[1,2]'])}) {element(less - 1)}"
        return f"[for(i={self.rounds(depth)}) {element(depth)}{self.pick(['', ',' + self.leaf(ANY), ','])}]"

    def bindings(self, depth):
        return ",".join(f"{self.pick(['a', 'b', '$g', 'p', 'f', 'g', '2d'])}={self.value(ANY, depth)}"
                        for _ in range(self.pick([0, 1, 1, 2])))

    def bound(self, wanted, depth):
        """An expression in let, echo, assert, or a function literal that is called."""
        kind = self.random.random()
        if kind < 0.5:
            return f"(let({self.bindings(depth)}) {self.value(wanted, depth)})"
        if kind < 0.7:
            return f"(echo({self.arguments({'a': ANY}, depth)}) {self.value(wanted, depth)})"
        if kind < 0.8:
            condition = self.value(ANY, depth) if self.is_aborting else self.pick(["true", "1", '"x"', "[0]"])
            return f"(assert({condition}{self.pick(['', ',' + self.value(STRING, depth)])}) {self.value(wanted, depth)})"
        return f"({self.value(FUNCTION, depth)})({self.arguments({'p': ANY, 'x': ANY}, depth)})"

    def parameters(self, depth):
        return self.pick(["", "p", "x", "p,q", f"p={self.value(ANY, depth)},q", f"p,$g={self.value(NUMBER, depth)}",
                          "p,p", "p,"])

    def arguments(self, names, depth, wanted=None):
        """Arguments by place, of the kinds that are wanted, or else of the names' kinds, and by name."""
        kinds = list(names.values()) if wanted is None else wanted
        count = self.pick([0, 1, 1, 2, 3]) if wanted is None else len(kinds) + self.pick([0] * 12 + [1, -1])
        found = [self.value(kinds[at] if at < len(kinds) else ANY, depth) for at in range(max(count, 0))]
        for name, kind in [*names.items(), ("zz", ANY), ("$g", NUMBER)]:
            if self.random.random() < (0.04 if name in ("zz", "$g") else 0.25):
                found.append(f"{name}={self.value(kind, depth)}")
        if self.one_in(6):
            self.random.shuffle(found)
        return ",".join(found) + ("," if found and self.one_in(12) else "")

    def call(self, wanted, depth):
        if self.one_in(12) and depth > 0:
            return f"rands({self.value(NUMBER, 1)},{self.value(NUMBER, 1)},{self.pick('0123')},{self.value(NUMBER, 1)})"
        name, _, arguments = self.pick([row for row in FUNCTIONS if row[1] == wanted or wanted in "armf"])
        named = {"p": ANY, "q": ANY} if name in ("g", "h", "uf", "f", "$f") and self.one_in(3) else {}
        return f"{name}({self.arguments(named, depth, arguments)})"

    def object(self, depth):
        """An object, or what is refused as one."""
        kind = self.random.random()
        if kind < 0.12:
            return f'import("{self.pick(["data", "data", "broken", "missing", "list"])}.json")'
        if kind < 0.25:
            function = self.pick(["fontmetrics", "textmetrics", "textmetrics"])
            kinds = {name: STRING if name in METRICS[2:7] + METRICS[:1] else NUMBER for name in METRICS}
            given = self.arguments(kinds if function == "textmetrics" else {"size": NUMBER}, 1).rstrip(",")
            return f'{function}({given}{"," if given else ""}font="DejaVu Sans")'
        entries = [f"[{self.pick(KEYS)},{self.value(ANY, depth - 1)}]" for _ in range(self.pick([0, 1, 2]))]
        entries += [f"[{self.pick(KEYS + ['1'])}]" for _ in range(self.pick([0, 0, 1]))]
        parts = [f"{name}={self.value(ANY, depth - 1)}" for name in self.random.sample(["a", "k", "x", "$g"], 2)]
        parts += [f"f={self.value(FUNCTION, depth - 1)}"] if self.one_in(2) else []
        parts += [f"[{','.join(entries)}]"] if self.one_in(2) else []
        parts += [self.object(depth - 1)] if depth > 1 and self.one_in(3) else []
        parts += [self.value(ANY, depth - 1)] if self.one_in(20) else []
        self.random.shuffle(parts)
        return f"object({','.join(parts)})"

    # Statements

    def statement(self, depth=3):
        modifier = self.pick([""] * 11 + ["#", "%", "*", "#%"])
        kind = self.random.random()
        if kind < 0.08:
            return f"{modifier}for(i={self.rounds(1)}) {self.body(depth)}"
        if kind < 0.15:
            other = f" else {self.body(depth)}" if self.one_in(2) else ""
            return f"{modifier}if({self.value(ANY, 2)}) {self.body(depth)}{other}"
        if kind < 0.21:
            return f"{modifier}let({self.bindings(1)}) {self.body(depth)}"
        if kind < 0.26:
            return f"{modifier}echo({self.arguments({'a': ANY, 'x y': ANY} if self.one_in(40) else {'a': ANY}, 2)}) {self.body(depth)}"
        if kind < 0.28:
            index = self.pick(["", "0", "1", "[0,1]", "[0:1]", "[1:-1:0]", "$g=7", "-1", "0,$g=2", self.value(ANY, 1)])
            return f"{modifier}children({index});"
        if kind < 0.29 and self.is_aborting:
            return f"assert({self.value(ANY, 2)},{self.value(ANY, 2)}) {self.body(depth)}"
        if self.one_in(40):
            return f"{modifier}assign(a={self.value(ANY, 1)},$g={self.value(ANY, 1)}) {self.body(depth)}"
        name = self.pick(list(MODULES))
        return f"{modifier}{name}({self.arguments(MODULES[name], self.pick([0, 1, 2]))}) {self.body(depth)}"

    def body(self, depth):
        if depth == 0 or self.one_in(2):
            return ";"
        if self.one_in(3):
            return self.statement(depth - 1)
        inside = [self.statement(depth - 1) for _ in range(self.pick([0, 1, 1, 2, 3]))]
        if self.one_in(3):
            inside.insert(0, f"{self.pick(['a', 'b', '$g', 'i'])}={self.value(ANY, 2)};")
        return "{" + " ".join(inside) + "}"

    # Files

    def beside(self):
        """Files that every design has beside it."""
        used = ("$g=1; $h=[2,3]; k=$g;\nfunction uf(p=$g,q)=[p,q,k,$g];\n"
                "module um(p,q=$g) { echo(p,q,$g); children(); }\n")
        data = ('{"z": 1, "a": [1, 2.5e-3, {"k": null}], "f": true, "x": "q\\"\\u00e9", '
                '"big": 12345678901234567890}')
        return {"used.scad": used, "data.json": data, "broken.json": '{"a": 1,}', "list.json": "[1, [2], {}]"}

    def definitions(self):
        """What expressions and statements name; it is the same for all of a design's lines."""
        return ["use <used.scad>", "use <font.ttf>",
                "o=object(a=1,k=[2,\"s\"],f=function(p,q=1) [p,q]); o2=object(o,f=function(p) p,size=[1,2]);",
                "f=function(p,q=1) [p,q]; $f=function(p=2,q) [p,q]; a=3; b=[1,2,3]; v=\"text\"; $g=4; 2d=2;",
                "function g(p=1,q=$g)=[p,q,$g]; function h(p,$g=4,q=$g)=p==undef?[p,$g,q]:g(p,q);",
                "function tail(n,s=0)=n>0&&n<50?tail(n-1,s+n):s;",
                "module m(p,q=a,$g=5) { echo(p,q,$g,$children); children(); }",
                "module n(p) { $g=p; %children(0); #children([0:$children-1]); }"]

    def lines(self, count, make):
        """A design with a line for each thing that is made."""
        return {**self.beside(), "design.scad": "\n".join(self.definitions() + [make() for _ in range(count)]) + "\n"}

    def expressions(self, count):
        return self.lines(count, lambda: f"echo({self.value(ANY)});")

    def trees(self, count):
        return self.lines(count, lambda: self.statement(self.pick([0, 1, 2, 3])))

    def reference(self, names):
        name = self.pick(MISSING if self.one_in(4) or not names else names)
        statement = "include" if names == FILES["lib/b.scad"] else self.pick(["include", "use"])
        return f"{statement}{self.pick([' ', '', chr(10)])}<{name}>{self.pick(['', '', ';', chr(10)])}"

    def definition(self):
        name = self.pick(["g", "h", "m", "n", "w", "2w"])
        if self.one_in(2):
            return f"function {name}({self.parameters(2)})={self.value(ANY, 3)};"
        inside = [self.definition()] if self.one_in(8) else []
        inside += [f"{self.pick(['c', 'p', '$g'])}={self.value(ANY, 2)};"] if self.one_in(2) else []
        inside += [self.pick(["children();", "%children(0);", "#children();", "echo(p,$g,$children,parent_module(0));"])]
        return f"module {name}({self.parameters(2)}) {{ {' '.join(inside + [self.statement(1)])} }}"

    def file(self, count, names):
        makers = [lambda: self.reference(names), self.definition, self.definition, self.statement, self.statement,
                  lambda: f"{self.pick(['a', 'b', 'c', '$g', 'f', '$f', '2d'])}={self.value(ANY, 3)};",
                  lambda: f"echo({self.value(ANY, 3)});"]
        pieces = [self.pick(makers)() for _ in range(count)]
        text = "".join(piece + self.pick(["\n", "\n", " ", "\r\n", " // c\n", " /* c\n */ "]) for piece in pieces)
        while self.one_in(12):
            at = self.random.randrange(len(text) + 1)
            text = text[:at] + self.pick(["", *PIECES]) + text[at + self.pick([0, 0, 1, 5]):]
        return text

    def files(self):
        """A design of several files, which include and use each other, with -D now and then."""
        self.is_aborting = True
        main = "\n".join(self.definitions()) + "\n" + "".join(
            f"{self.pick(['include', 'use'])} <{name}>\n" for name in FILES if self.one_in(2))
        main += "echo($vpt,$vpr,$vpd,$vpf);\n" + self.file(14, NAMED_BY_MAIN)
        return {**self.beside(), **{name: self.file(self.pick([1, 3, 6]), names) for name, names in FILES.items()}, "design.scad": main}

    def options(self):
        options = ["--enable=lazy-union"] if self.one_in(4) else []
        if self.one_in(5):
            numbers = [self.pick([0, 1, 10, -20, 33.5, 400]) for _ in range(self.pick([6, 7]))]
            options.append("--camera=" + ",".join(str(number) for number in numbers))
        if self.one_in(8):
            options += ["-D", self.pick([f"{self.pick(['a', '$g', 'b'])}={self.value(ANY, 2)}", self.statement(1),
                                         self.definition(), self.pick(PIECES)])]
        if self.one_in(30):
            options.append("--hardwarnings")
        return options
