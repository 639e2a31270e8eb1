"""Numbers of sentences, read back."""


def number(text):
    mantissa, _, power = text.replace("−", "-").partition(" · 10")
    digits = power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    return float(mantissa) * 10.0 ** int(digits or 0)
